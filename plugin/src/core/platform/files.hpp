// Files and folders. Paths are UTF-8 on every system.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace frond {

struct FileStatus {
    bool exists = false, is_regular = false, is_folder = false;
    uint64_t size = 0;  // [byte] of a regular file
    std::string error;  // the system's words if it does not exist
};
// Follows links.
FileStatus status_of(const std::string& path);
inline bool is_regular_file(const std::string& path) {
    return status_of(path).is_regular;
}

// Reads at most `most` bytes. Returns false, with the system's words in `error`, if the file cannot be opened.
bool read_file(const std::string& path, uint64_t most, std::string& bytes, std::string& error);
// Returns false, with the system's words in `error`, unless all bytes are written.
bool write_file(const std::string& path, const std::string& bytes, std::string& error);

// Returns the absolute path without links, by slashes; "" if there is no such file.
std::string real_path(const std::string& path);
bool is_absolute(const std::string& path);
// Returns what follows the last separator, and what stands before it: "." if there is none.
std::string file_name(const std::string& path);
std::string folder_of(const std::string& path);
// Returns whether a name ends in ".obj" or the like, in either case, after at least one more letter.
bool has_ending(const std::string& path, const char* ending);

struct FolderEntry {
    std::string name;
    bool is_regular, is_folder;  // links are neither
};
// Lists a folder in the system's order, at most `most` entries; nothing if it cannot be read.
std::vector<FolderEntry> entries_of(const std::string& folder, size_t most);

}  // namespace frond
