// A program for tests to start as a child.
//   talk WORD COUNT   says the word as an error, writes a letter so often
//   crash             reads where nothing is
//   spin SECONDS      works for ever, with so much time of a processor
//   ask MIB LIMIT     asks for memory, of which it may have so much
//   wait              says "ready", then does nothing for long
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "core/platform/process.hpp"

using namespace frond;

int main(int argc, char** argv) {
    const std::vector<std::string> words = own_arguments(argc, argv);
    const std::string what = words.size() > 1 ? words[1] : "";
    const auto number = [&](size_t i) { return words.size() > i ? std::strtod(words[i].c_str(), nullptr) : 0; };
    is_output_a_terminal();
    if (what == "talk") {
        std::fputs(words.at(2).c_str(), stderr);
        return write_output(std::string(size_t(number(3)), 'x')) ? 3 : 1;
    }
    if (what == "crash") {
        limit_self({});
        std::signal(SIGSEGV, SIG_DFL);  // sanitizers end a program by an exit of their own
        *static_cast<volatile int*>(nullptr);
    }
    if (what == "spin") {
        limit_self({number(2), 0, 0});
        for (volatile unsigned turn = 0;; turn = turn + 1) {
        }
    }
    if (what == "ask") {
        limit_self({0, 0, number(3)});
        const size_t size = size_t(number(2)) << 20;
        auto* memory = static_cast<char*>(std::malloc(size));
        if (memory) std::memset(memory, 1, size);
        const bool got = memory && memory[size / 2] == 1;
        write_output(got ? "got it" : "got none");
        std::free(memory);
    }
    if (what == "wait") {
        write_output("ready");
        std::this_thread::sleep_for(std::chrono::seconds(100));
    }
    return 0;
}
