#include "programs/copy.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "scenes/scene.hpp"

namespace frond::programs {

void run_in_copy(const std::function<void(int out)>& work, const std::function<void(int in, int status)>& read) {
    int ends[2];
    if (pipe(ends) != 0) throw tools::SceneError(std::string("no pipe: ") + std::strerror(errno));
    const pid_t child = fork();
    if (child < 0) throw tools::SceneError(std::string("no process: ") + std::strerror(errno));
    if (child == 0) {
        try {
            work(ends[1]);
        } catch (const std::exception&) {
        }
        _exit(1);
    }
    close(ends[1]);
    int status = 0;
    waitpid(child, &status, 0);
    read(ends[0], status);
    close(ends[0]);
}

}  // namespace frond::programs
