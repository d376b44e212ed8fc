// Processes by Windows: a job holds the child's limits and ends it with its host. In: a program and its arguments. Out:
// what it writes, and how it ended.
#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
// After it.
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>
#include <stdio.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/platform/files.hpp"
#include "core/platform/process.hpp"

namespace frond {

const char BETWEEN_PATHS = ';';
const char* const PROGRAM_ENDING = ".exe";

// A handle that closes itself.
struct Handle {
    HANDLE handle = nullptr;
    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { reset(); }
    void reset() {
        if (handle && handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
        handle = nullptr;
    }
};

namespace {

[[noreturn]] void throw_last() {
    throw std::system_error(int(GetLastError()), std::system_category());
}

// One end for us, one that the child inherits.
void open_pipe(Handle& reading, Handle& writing) {
    SECURITY_ATTRIBUTES inherited = {sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    if (!CreatePipe(&reading.handle, &writing.handle, &inherited, 0)) throw_last();
    SetHandleInformation(reading.handle, HANDLE_FLAG_INHERIT, 0);
}

// A process that is out of memory gets none; one that is out of time is ended.
void make_job(const ProcessLimits& limits, Handle& job) {
    job.handle = CreateJobObjectW(nullptr, nullptr);
    if (!job.handle) throw_last();
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION most = {};
    most.BasicLimitInformation.LimitFlags =
        JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    if (limits.cpu_seconds > 0) {
        most.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_TIME;
        most.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = LONGLONG(1e7 * limits.cpu_seconds);
    }
    if (limits.memory_mib > 0) {
        most.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
        most.ProcessMemoryLimit = SIZE_T(limits.memory_mib * 1048576);
    }
    SetInformationJobObject(job.handle, JobObjectExtendedLimitInformation, &most, sizeof most);
}

std::wstring wide(const std::string& text) {
    return std::filesystem::u8path(text).wstring();
}

// Quotes an argument as the C runtime reads it: backslashes count double before a quote.
std::wstring quoted(const std::string& argument) {
    std::wstring out = L"\"";
    size_t slashes = 0;
    for (wchar_t letter : wide(argument)) {
        if (letter == L'"') out.append(slashes + 1, L'\\');
        slashes = letter == L'\\' ? slashes + 1 : 0;
        out += letter;
    }
    return out.append(slashes, L'\\') + L"\"";
}

std::string path_of_module(HMODULE module) {
    std::wstring path(32768, L'\0');
    path.resize(GetModuleFileNameW(module, path.data(), DWORD(path.size())));
    return std::filesystem::path(path).generic_u8string();
}

}  // namespace

struct Child::Inside {
    Handle job, process, output, messages;
    // What two threads have read and hear() has not fetched yet.
    std::mutex mutex;
    std::condition_variable news;
    std::string heard[2];
    int ended = 0;  // of the two
    std::thread readers[2];

    void listen(int which) {
        const HANDLE from = which == 0 ? output.handle : messages.handle;
        char buffer[65536];
        for (DWORD count = 0; ReadFile(from, buffer, sizeof buffer, &count, nullptr) && count > 0;) {
            const std::lock_guard<std::mutex> lock(mutex);
            heard[which].append(buffer, count);
            news.notify_one();
        }
        const std::lock_guard<std::mutex> lock(mutex);
        ended++;
        news.notify_one();
    }
};

Child::Child(const std::string& program, const std::vector<std::string>& arguments, const ProcessLimits& limits)
    : inside(new Inside) {
    Handle written, said, nothing;
    open_pipe(inside->output, written);
    open_pipe(inside->messages, said);
    SECURITY_ATTRIBUTES inherited = {sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    nothing.handle =
        CreateFileW(L"NUL", GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr);
    make_job(limits, inside->job);

    // The child inherits these three handles alone.
    HANDLE handles[] = {nothing.handle, written.handle, said.handle};
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<char> memory(size);
    STARTUPINFOEXW start = {};
    start.StartupInfo.cb = sizeof start;
    start.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    start.StartupInfo.hStdInput = handles[0];
    start.StartupInfo.hStdOutput = handles[1];
    start.StartupInfo.hStdError = handles[2];
    start.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.data());
    if (!InitializeProcThreadAttributeList(start.lpAttributeList, 1, 0, &size)) throw_last();
    UpdateProcThreadAttribute(start.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles, sizeof handles,
                              nullptr, nullptr);
    std::wstring line = quoted(program);
    for (const std::string& argument : arguments) line += L" " + quoted(argument);
    PROCESS_INFORMATION made = {};
    const bool has_started = CreateProcessW(wide(program).c_str(), line.data(), nullptr, nullptr, TRUE,
                                            CREATE_SUSPENDED | CREATE_NO_WINDOW | EXTENDED_STARTUPINFO_PRESENT, nullptr,
                                            nullptr, &start.StartupInfo, &made);
    const DWORD error = GetLastError();
    DeleteProcThreadAttributeList(start.lpAttributeList);
    if (!has_started) throw std::system_error(int(error), std::system_category());
    inside->process.handle = made.hProcess;
    if (!AssignProcessToJobObject(inside->job.handle, made.hProcess)) {
        const DWORD refused = GetLastError();
        TerminateProcess(made.hProcess, 1);
        CloseHandle(made.hThread);
        throw std::system_error(int(refused), std::system_category());
    }
    ResumeThread(made.hThread);
    CloseHandle(made.hThread);
    written.reset();
    said.reset();
    for (int which : {0, 1}) inside->readers[which] = std::thread(&Inside::listen, inside.get(), which);
}

Child::~Child() {
    if (inside->process.handle) end(true);
}

bool Child::hear(double most_ms, std::string& output, std::string& errors) {
    std::unique_lock<std::mutex> lock(inside->mutex);
    std::string* const heard = inside->heard;
    inside->news.wait_for(lock, std::chrono::duration<double, std::milli>(std::max(most_ms, 0.0)),
                          [&] { return inside->ended == 2 || !heard[0].empty() || !heard[1].empty(); });
    output += heard[0], errors += heard[1];
    heard[0].clear(), heard[1].clear();
    return inside->ended < 2;
}

ChildEnd Child::end(bool stop) {
    if (stop) TerminateJobObject(inside->job.handle, 1);
    WaitForSingleObject(inside->process.handle, INFINITE);
    DWORD code = 0;
    GetExitCodeProcess(inside->process.handle, &code);
    inside->process.reset();
    for (std::thread& reader : inside->readers) reader.join();
    if (code < 256) return {ChildEnd::EXITED, ""};
    constexpr DWORD QUOTA_EXCEEDED = 0xC0000044;
    char words[32];
    snprintf(words, sizeof words, "code 0x%08lx", code);
    return {code == ERROR_NOT_ENOUGH_QUOTA || code == QUOTA_EXCEEDED ? ChildEnd::OUT_OF_CPU_TIME : ChildEnd::CRASHED,
            words};
}

std::vector<std::string> own_arguments(int, char**) {
    int count = 0;
    wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> arguments;
    for (int i = 0; i < count; i++) arguments.push_back(std::filesystem::path(words[i]).u8string());
    LocalFree(words);
    return arguments;
}

static LONG WINAPI end_with_its_code(EXCEPTION_POINTERS* exception) {
    TerminateProcess(GetCurrentProcess(), exception->ExceptionRecord->ExceptionCode);
    return EXCEPTION_EXECUTE_HANDLER;
}

// The host's job holds the limits. What crashes ends, without a report or a debugger that waits for somebody.
void limit_self(const ProcessLimits&) {
    SetUnhandledExceptionFilter(end_with_its_code);
    SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
}

bool is_output_a_terminal() {
    _setmode(_fileno(stdout), _O_BINARY);
    return _isatty(_fileno(stdout)) != 0;
}

bool write_output(const std::string& bytes) {
    return fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && fflush(stdout) == 0;
}

void leave(int status) {
    TerminateProcess(GetCurrentProcess(), UINT(status));
    abort();
}

std::string environment(const char* name) {
    const std::wstring key(name, name + strlen(name));
    std::wstring value(32768, L'\0');
    value.resize(GetEnvironmentVariableW(key.c_str(), value.data(), DWORD(value.size())));
    return std::filesystem::path(value).u8string();
}

bool is_program(const std::string& path) {
    return is_regular_file(path);
}

std::vector<std::string> own_folders() {
    HMODULE module = nullptr;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&own_folders), &module);
    return {folder_of(path_of_module(module)), folder_of(path_of_module(nullptr))};
}

}  // namespace frond
