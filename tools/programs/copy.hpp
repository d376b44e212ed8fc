// run_in_copy: what a program does in a copy of this process, which may crash or change everything.
#pragma once

#include <functional>

namespace frond::programs {

// Runs `work` in a copy of this process, then `read` here, with the copy's report and its status as waitpid() gives it.
// The report is less than a pipe holds. The copy ends with status 1 if `work` returns or throws. Throws a SceneError
// where there is no pipe or no process.
void run_in_copy(const std::function<void(int out)>& work, const std::function<void(int in, int status)>& read);

}  // namespace frond::programs
