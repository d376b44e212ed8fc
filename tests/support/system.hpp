// What tests ask of the system: folders for a while, and the environment.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <random>
#include <string>

// Makes an empty folder of its own and returns its path, by slashes.
inline std::string make_temporary_folder() {
    std::random_device random;
    for (;;) {
        const std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("frond-test-" + std::to_string(random()));
        if (std::filesystem::create_directory(path)) return path.generic_string();
    }
}

// Null: the variable is taken away.
inline void set_environment(const char* name, const char* value) {
#ifdef _WIN32
    _putenv_s(name, value ? value : "");
#else
    value ? setenv(name, value, 1) : unsetenv(name);
#endif
}
