// Progress on a terminal, a line that is written over.
#include <unistd.h>

#include <cstdio>

#include "studio/studio.hpp"

namespace frond::tools {

Progress::Progress(const char* what, int total)
    : what(what),
      total(total),
      on_terminal(isatty(STDERR_FILENO)),
      start(std::chrono::steady_clock::now()),
      last(start) {}

Progress::~Progress() {
    if (shown) std::fprintf(stderr, "\r\033[K");
}

void Progress::at(int done) {
    if (!on_terminal) return;
    const auto now = std::chrono::steady_clock::now();
    using seconds = std::chrono::duration<double>;
    if (seconds(now - start).count() < 1 || seconds(now - last).count() < 0.2) return;
    last = now;
    shown = true;
    std::fprintf(stderr, "\r%s %d of %d\033[K", what, done, total);
}

}  // namespace frond::tools
