// A plain driver for the targets beside it, for compilers without libFuzzer: the same entry function, the same options.
//
//     fuzz_calls [-runs=N] [-max_total_time=S] [-seed=N] [-max_len=N] [corpus folder or file ...]
//
// Runs the corpus as it is, then mutations of it. The input of each run is first written to crash.bin, so that it can
// be run again after a crash.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

using Bytes = std::vector<uint8_t>;

struct Options {
    long runs = -1, seconds = 0;
    size_t longest = 4096;
    unsigned seed = 1;
    std::vector<std::string> paths;
};

Options options_of(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; i++) {
        long value = 0;
        if (std::sscanf(argv[i], "-runs=%ld", &value) == 1)
            options.runs = value;
        else if (std::sscanf(argv[i], "-max_total_time=%ld", &value) == 1)
            options.seconds = value;
        else if (std::sscanf(argv[i], "-seed=%ld", &value) == 1)
            options.seed = unsigned(value);
        else if (std::sscanf(argv[i], "-max_len=%ld", &value) == 1)
            options.longest = size_t(value);
        else
            options.paths.push_back(argv[i]);
    }
    if (options.runs < 0 && options.seconds == 0) options.runs = 0;
    return options;
}

Bytes read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
}

std::vector<Bytes> read_corpus(const std::vector<std::string>& paths) {
    std::vector<Bytes> corpus;
    for (const std::string& path : paths) {
        if (!std::filesystem::is_directory(path)) {
            corpus.push_back(read_file(path));
            continue;
        }
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const auto& file : files) corpus.push_back(read_file(file));
    }
    return corpus;
}

void mutate(Bytes& bytes, std::mt19937& random, const std::vector<Bytes>& corpus, size_t longest) {
    static const double NUMBERS[] = {0, -1, 1, 1e30, -1e308, 1e-300, NAN, INFINITY, 2147483647, 0.5};
    const auto below = [&](size_t count) { return count ? size_t(random()) % count : 0; };
    for (size_t left = 1 + below(4); left > 0; left--) {
        const size_t at = below(bytes.size() + 1);
        switch (below(7)) {
            case 0:
                if (at < bytes.size()) bytes[at] ^= uint8_t(1u << below(8));
                break;
            case 1:
                if (at < bytes.size()) bytes[at] = uint8_t(random());
                break;
            case 2:
                bytes.insert(bytes.begin() + long(at), uint8_t(random()));
                break;
            case 3:
                bytes.erase(bytes.begin() + long(at),
                            bytes.begin() + long(at + below(std::min<size_t>(16, bytes.size() - at))));
                break;
            case 4: {
                const double number = NUMBERS[below(sizeof NUMBERS / sizeof *NUMBERS)];
                if (at + sizeof number <= bytes.size()) std::memcpy(&bytes[at], &number, sizeof number);
                break;
            }
            case 5: {
                const int32_t number = int32_t(below(2) ? random() : below(300)) - 20;
                if (at + sizeof number <= bytes.size()) std::memcpy(&bytes[at], &number, sizeof number);
                break;
            }
            default: {
                if (corpus.empty()) break;
                const Bytes& other = corpus[below(corpus.size())];
                const size_t from = below(other.size()), count = below(std::min<size_t>(256, other.size() - from));
                bytes.insert(bytes.begin() + long(at), other.begin() + long(from), other.begin() + long(from + count));
            }
        }
    }
    if (bytes.size() > longest) bytes.resize(longest);
}

void run(const Bytes& bytes) {
    std::ofstream("crash.bin", std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), long(bytes.size()));
    const Bytes copy(bytes);  // of exact length, for the address sanitizer
    LLVMFuzzerTestOneInput(copy.data(), copy.size());
}

}  // namespace

int main(int argc, char** argv) {
    const Options options = options_of(argc, argv);
    std::vector<Bytes> corpus = read_corpus(options.paths);
    std::mt19937 random(options.seed);
    for (const Bytes& bytes : corpus) run(bytes);
    const auto start = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    long runs = 0;
    for (; (options.runs < 0 || runs < options.runs) && (options.seconds == 0 || passed() < double(options.seconds));
         runs++) {
        Bytes bytes;
        if (!corpus.empty() && random() % 8 != 0)
            bytes = corpus[random() % corpus.size()];
        else
            for (size_t i = random() % options.longest; i > 0; i--) bytes.push_back(uint8_t(random()));
        mutate(bytes, random, corpus, options.longest);
        run(bytes);
    }
    std::remove("crash.bin");
    std::printf("%zu files, %ld mutations, %.1f s: nothing found\n", corpus.size(), runs, passed());
    return 0;
}
