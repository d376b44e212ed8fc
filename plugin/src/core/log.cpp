#include "core/log.hpp"

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace frond {

static void log_to_stderr(const char* message, void*) {
    std::fprintf(stderr, "frond: %s\n", message);
}

static std::mutex log_mutex;
static frond_log_fn* log_function = log_to_stderr;
static void* log_user = nullptr;

void set_log(frond_log_fn* log, void* user) {
    std::lock_guard<std::mutex> lock(log_mutex);
    log_function = log;
    log_user = user;
}

void warn(const char* format, ...) {
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);

    // The function is called outside the lock, so that it may call back into Frond.
    frond_log_fn* log;
    void* user;
    {
        std::lock_guard<std::mutex> lock(log_mutex);
        log = log_function;
        user = log_user;
    }
    if (log) log(message, user);
}

}  // namespace frond
