// The importer's process among what POSIX lets a host do: wrong programs, signals, threads, closed descriptors.
#include <dirent.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "core/timer.hpp"
#include "io/import_damage.hpp"

namespace import_damage_tests {

int count_descriptors() {
    int count = 0;
    DIR* directory = opendir("/proc/self/fd");
    while (readdir(directory)) ++count;
    closedir(directory);
    return count;
}

TEST_F(ImportDamage, AWrongImporterIsNamedWithItsRemedy) {
    files::Folder folder;
    const std::string path = folder.write("a.obj", files::obj());
    for (const char* wrong : {"/nowhere/frond-import", "/tmp", "/bin/true", "/bin/cat", "/bin/yes"}) {
        set_environment("FROND_IMPORTER", wrong);
        const std::string error = error_of(path);
        set_environment("FROND_IMPORTER", nullptr);
        EXPECT_NE(error.find("FROND_IMPORTER"), std::string::npos) << wrong << ": " << error;
    }
    EXPECT_EQ(error_of(path), "");
}

TEST_F(ImportDamage, AProgramThatNeverEndsIsEnded) {
    files::Folder folder;
    const std::string program = folder.write("sleeper", "#!/bin/sh\nsleep 100\n");
    ASSERT_EQ(chmod(program.c_str(), 0755), 0);
    const std::string path = folder.write("a.obj", files::obj());
    set_environment("FROND_IMPORTER", program.c_str());
    ImportLimits limits;
    limits.wall_seconds = 1;
    const Timer timer;
    EXPECT_THROW(run_importer(path, limits), Error);
    set_environment("FROND_IMPORTER", nullptr);
    EXPECT_LT(timer.ms(), 20000);
}

TEST_F(ImportDamage, WorksWhenTheHostIgnoresOrReapsChildren) {
    files::Folder folder;
    const std::string good = folder.write("a.obj", files::obj()), bad = folder.write("b.obj", "v 0 0 0\n");
    const auto before = signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(error_of(good), "");
    EXPECT_NE(error_of(bad), "");
    signal(SIGCHLD, [](int) {
        while (waitpid(-1, nullptr, WNOHANG) > 0) {
        }
    });
    EXPECT_EQ(error_of(good), "");
    EXPECT_NE(error_of(bad), "");
    signal(SIGCHLD, before);
}

TEST_F(ImportDamage, ManyThreadsImportAtOnceAndNothingIsLeaked) {
    files::Folder folder;
    const std::vector<Sample> rows = samples();
    std::vector<std::string> paths;
    for (const Sample& row : rows) paths.push_back(folder.write(row.name, row.bytes));
    import_surface(paths[0], {});
    const int before = count_descriptors();
    std::vector<std::thread> threads;
    std::vector<int> good(8, 0);
    for (size_t t = 0; t < good.size(); ++t)
        threads.emplace_back([&, t] {
            for (size_t i = 0; i < paths.size(); ++i) good[t] += error_of(paths[(i + t) % paths.size()]).empty();
        });
    for (std::thread& thread : threads) thread.join();
    for (int count : good) EXPECT_EQ(count, int(paths.size()));
    EXPECT_EQ(count_descriptors(), before);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a zombie is left";
}

TEST_F(ImportDamage, WorksWithoutStandardDescriptors) {
    // In a child process, so that this process keeps its descriptors.
    files::Folder folder;
    const std::string path = folder.write("a.obj", files::obj());
    const pid_t child = fork();
    if (child == 0) {
        close(0);
        close(1);
        close(2);
        _exit(error_of(path).empty() ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

}  // namespace import_damage_tests
