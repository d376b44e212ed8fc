// In: paths. Out: what the standard library's file system and streams tell of them.
#include "core/platform/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace frond {

namespace {

namespace fs = std::filesystem;

constexpr bool HAS_DRIVES = fs::path::preferred_separator != '/';
constexpr const char* SEPARATORS = HAS_DRIVES ? "/\\" : "/";

// A zero byte would end a path early.
fs::path path_of(const std::string& text) {
    return text.find('\0') == std::string::npos ? fs::u8path(text) : fs::path();
}

char lower(char letter) {
    return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter;
}

}  // namespace

FileStatus status_of(const std::string& path) {
    FileStatus status;
    std::error_code error;
    const fs::path found = path_of(path);
    const fs::file_status known = fs::status(found, error);
    status.exists = fs::exists(known);
    status.is_regular = fs::is_regular_file(known);
    status.is_folder = fs::is_directory(known);
    if (!status.exists)
        status.error = (error ? error : std::make_error_code(std::errc::no_such_file_or_directory)).message();
    if (status.is_regular) {
        const uintmax_t size = fs::file_size(found, error);
        status.size = error ? 0 : size;
    }
    return status;
}

bool read_file(const std::string& path, uint64_t most, std::string& bytes, std::string& error) {
    bytes.clear();
    errno = 0;
    std::ifstream stream(path_of(path), std::ios::binary);
    if (!stream) {
        error = std::strerror(errno != 0 ? errno : ENOENT);
        return false;
    }
    char block[65536];
    while (bytes.size() < most && stream) {
        stream.read(block, std::streamsize(std::min<uint64_t>(sizeof block, most - bytes.size())));
        bytes.append(block, size_t(stream.gcount()));
    }
    return true;
}

bool write_file(const std::string& path, const std::string& bytes, std::string& error) {
    errno = 0;
    std::ofstream stream(path_of(path), std::ios::binary);
    if (stream) stream.write(bytes.data(), std::streamsize(bytes.size()));
    stream.close();
    if (!stream) error = std::strerror(errno != 0 ? errno : EIO);
    return bool(stream);
}

std::string real_path(const std::string& path) {
    std::error_code error;
    const fs::path real = fs::canonical(path_of(path), error);
    return error ? "" : real.generic_u8string();
}

bool is_absolute(const std::string& path) {
    return path_of(path).is_absolute();
}

std::string file_name(const std::string& path) {
    return path.substr(path.find_last_of(SEPARATORS) + 1);
}

std::string folder_of(const std::string& path) {
    const size_t at = path.find_last_of(SEPARATORS);
    return at == std::string::npos ? "." : at == 0 ? "/" : path.substr(0, at);
}

bool has_ending(const std::string& path, const char* ending) {
    const size_t length = std::strlen(ending);
    if (path.size() <= length) return false;
    for (size_t i = 0; i < length; i++)
        if (lower(path[path.size() - length + i]) != lower(ending[i])) return false;
    return true;
}

std::vector<FolderEntry> entries_of(const std::string& folder, size_t most) {
    std::vector<FolderEntry> entries;
    std::error_code error;
    for (fs::directory_iterator at(path_of(folder), error), end; !error && at != end && entries.size() < most;
         at.increment(error)) {
        std::error_code unknown;
        const fs::file_status status = at->symlink_status(unknown);
        entries.push_back({at->path().filename().u8string(), fs::is_regular_file(status), fs::is_directory(status)});
    }
    return entries;
}

}  // namespace frond
