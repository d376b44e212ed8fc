#include "core/assert.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace frond {

static void write_and_abort(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: this does not hold: %s\n", file, line, condition);
    std::abort();
}

static std::atomic<AssertHandler*> assert_handler{write_and_abort};

AssertHandler* set_assert_handler(AssertHandler* handler) {
    return assert_handler.exchange(handler ? handler : write_and_abort);
}

void tell_failed_assert(const char* condition, const char* file, int line) {
    assert_handler.load()(condition, file, line);
}

}  // namespace frond
