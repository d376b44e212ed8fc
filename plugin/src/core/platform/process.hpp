// Processes: a child with limits whose output comes through pipes, and what a child does about itself.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace frond {

struct ProcessLimits {
    double cpu_seconds = 0, wall_seconds = 0, memory_mib = 0;  // 0: none
};

// How a child ended. Only a hint: a POSIX host may ignore SIGCHLD or reap our child before us.
struct ChildEnd {
    enum { UNKNOWN, EXITED, CRASHED, OUT_OF_CPU_TIME, OUT_OF_WALL_TIME } how = UNKNOWN;
    std::string words;  // of a crash: "signal 11"
};

// A program that has been started. It inherits two pipes and the environment, nothing else of the host's.
class Child {
public:
    // On Windows the child gets the limits here; elsewhere it has to set them itself, by limit_self(). Throws
    // std::system_error.
    Child(const std::string& program, const std::vector<std::string>& arguments, const ProcessLimits& limits);
    // Stops it if it still runs.
    ~Child();
    // Waits for the child to write, at most for that time, and appends what it wrote. Returns false once its output has
    // ended.
    bool hear(double most_ms, std::string& output, std::string& errors);
    // Waits for its end, after stopping it if so wanted.
    ChildEnd end(bool stop);

private:
    struct Inside;
    std::unique_ptr<Inside> inside;
};

// Returns the words that this program was started with, its own name first, in UTF-8.
std::vector<std::string> own_arguments(int count, char** words);
// Limits this process, which also ends with the one that started it.
void limit_self(const ProcessLimits& limits);
// Returns whether standard output is a terminal; makes it binary.
bool is_output_a_terminal();
// Writes to standard output; returns false if that fails.
bool write_output(const std::string& bytes);
// Ends this process without destructors.
[[noreturn]] void leave(int status);

// Returns a variable of the environment; "" if there is none, or if the program has more rights than its caller.
std::string environment(const char* name);
extern const char BETWEEN_PATHS;          // in a list of paths in the environment
extern const char* const PROGRAM_ENDING;  // of the names of programs

bool is_program(const std::string& path);
// Returns the folders of the library or program that holds an address in this library, and of the running program.
std::vector<std::string> own_folders();

}  // namespace frond
