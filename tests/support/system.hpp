// What tests ask of the system: folders for a while, the environment, aligned memory.
#pragma once

#include <stdlib.h>
#ifdef _WIN32
#include <malloc.h>
#endif

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

// Null if there is none.
inline void* allocate_aligned(size_t size, size_t alignment) {
#ifdef _WIN32
    return _aligned_malloc(size, alignment);
#else
    void* memory = nullptr;
    return posix_memalign(&memory, alignment, size) == 0 ? memory : nullptr;
#endif
}
inline void free_aligned(void* memory) {
#ifdef _WIN32
    _aligned_free(memory);
#else
    free(memory);
#endif
}
