// In: this program. Out: the work of its kernels, instruction by instruction.
//
// Callgrind counts how often the instruction at each address ran; objdump gives the instruction: how many numbers it
// works on, and how many bytes of memory it names.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <unordered_map>

#include "callgrind/count_self.hpp"
#include "callgrind/requests.hpp"
#include "kernels/kernels.hpp"

namespace frond::kernels {

using tools::begins_with;

namespace {

struct Instruction {
    double flops = 0, bytes = 0;
};

// Reads an instruction as objdump prints it in Intel syntax: "vmulpd ymm0,ymm1,YMMWORD PTR [rax]".
Instruction read_instruction(const std::string& text) {
    static const std::pair<const char*, int> SIZES[] = {{"YMMWORD PTR", 32}, {"XMMWORD PTR", 16}, {"QWORD PTR", 8},
                                                        {"DWORD PTR", 4},    {"WORD PTR", 2},     {"BYTE PTR", 1}};
    Instruction out;
    for (const auto& [word, bytes] : SIZES)
        if (text.find(word) != std::string::npos) {
            out.bytes = bytes;
            break;
        }
    const std::string name = text.substr(text[0] == 'v' ? 1 : 0, text.find(' ') - (text[0] == 'v' ? 1 : 0));
    for (const char* word : {"addsub", "add", "sub", "mul", "div", "sqrt", "hadd"}) {
        if (!begins_with(name, word)) continue;
        const std::string kind = name.substr(std::strlen(word));
        const bool is_wide = text.find("ymm") != std::string::npos;
        if (kind == "pd") out.flops = is_wide ? 4 : 2;
        if (kind == "ps") out.flops = is_wide ? 8 : 4;
        if (kind == "sd" || kind == "ss") out.flops = 1;
        break;
    }
    return out;
}

// Returns the program's instructions by address.
std::unordered_map<unsigned long, Instruction> disassemble(const std::string& program) {
    std::unordered_map<unsigned long, Instruction> all;
    const std::string command = "objdump -d -M intel --no-show-raw-insn '" + program + "' 2> /dev/null";
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return all;
    std::array<char, 4096> line;
    while (std::fgets(line.data(), int(line.size()), pipe)) {
        char* end = nullptr;
        const unsigned long address = std::strtoul(line.data(), &end, 16);
        if (end == line.data() || std::strncmp(end, ":\t", 2) != 0) continue;
        const Instruction instruction = read_instruction(end + 2);
        if (instruction.flops > 0 || instruction.bytes > 0) all[address] = instruction;
    }
    pclose(pipe);
    return all;
}

// Lines are "0xaddress line count"; the one after "calls=" has the cost of the call, which is counted in the called
// function.
Work read_part(const std::vector<std::string>& lines, const std::string& program,
               const std::unordered_map<unsigned long, Instruction>& instructions) {
    Work work;
    bool is_own = false, is_call = false;
    for (const std::string& line : lines) {
        if (begins_with(line, "ob=")) is_own = line.substr(3) == program;
        if (begins_with(line, "calls=")) {
            is_call = true;
            continue;
        }
        if (!begins_with(line, "0x")) continue;
        const bool is_counted = !is_call;
        is_call = false;
        if (!is_counted) continue;
        char* end = nullptr;
        const unsigned long address = std::strtoul(line.c_str(), &end, 16);
        std::strtol(end, &end, 10);
        const double count = std::strtod(end, nullptr);
        work.instructions += count;
        const auto found = is_own ? instructions.find(address) : instructions.end();
        if (found == instructions.end()) continue;
        work.flops += count * found->second.flops;
        work.bytes += count * found->second.bytes;
    }
    return work;
}

}  // namespace

void run_to_be_counted(const std::vector<Kernel>& kernels) {
    for (const Kernel& kernel : kernels) {
        kernel.run();
        CALLGRIND_START_INSTRUMENTATION;
        kernel.run();
        CALLGRIND_STOP_INSTRUMENTATION;
        CALLGRIND_DUMP_STATS_AT(kernel.name.c_str());
    }
}

std::map<std::string, Work> count_work() {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::unordered_map<unsigned long, Instruction> instructions = disassemble(self);
    std::map<std::string, Work> all;
    if (instructions.empty()) return all;
    for (const auto& [name, lines] :
         tools::count_self("--inside", "--instr-atstart=no --dump-instr=yes --compress-pos=no --compress-strings=no"))
        all[name] = read_part(lines, self, instructions);
    return all;
}

}  // namespace frond::kernels
