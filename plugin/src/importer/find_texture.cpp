// Finds and reads the files that a model refers to. Nothing outside the model's folder is opened: a path that leaves it
// is looked up by its bare file name inside instead (artists' files are full of paths of other machines).
#include <dirent.h>
#include <limits.h>
#include <stdlib.h>
#include <strings.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstring>

#include "core/log.hpp"
#include "importer/importer.hpp"

namespace frond {

static constexpr size_t LARGEST_TEXTURE = size_t(128) << 20, ALL_TEXTURES = size_t(768) << 20;  // [byte]
static constexpr int DEEPEST_FOLDER = 4, MOST_ENTRIES = 20000;

static std::string real_path(const std::string& path) {
    char resolved[PATH_MAX];
    return path.find('\0') == std::string::npos && realpath(path.c_str(), resolved) ? resolved : "";
}

static bool is_file(const std::string& path) {
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

// Looks for a file name in a folder and those below it; links to folders are not followed.
static std::string search_folder(const std::string& folder, const std::string& name, int depth, int& entries) {
    DIR* directory = opendir(folder.c_str());
    if (!directory) return "";
    std::string found;
    std::vector<std::string> below;
    while (dirent* entry = readdir(directory)) {
        if (++entries > MOST_ENTRIES) break;
        const std::string path = folder + "/" + entry->d_name;
        struct stat status;
        if (entry->d_name[0] == '.' || lstat(path.c_str(), &status) != 0) continue;
        if (S_ISDIR(status.st_mode)) below.push_back(path);
        if (S_ISREG(status.st_mode) && strcasecmp(entry->d_name, name.c_str()) == 0) found = path;
        if (!found.empty() && name == entry->d_name) break;
    }
    closedir(directory);
    for (size_t i = 0; found.empty() && depth < DEEPEST_FOLDER && i < below.size(); ++i)
        found = search_folder(below[i], name, depth + 1, entries);
    return found;
}

// "a%20b" -> "a b"
static std::string decode_uri(const std::string& text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && isxdigit(uint8_t(text[i + 1])) && isxdigit(uint8_t(text[i + 2]))) {
            out += char(strtol(text.substr(i + 1, 2).c_str(), nullptr, 16));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

static std::string find_exactly(const std::string& folder, std::string reference) {
    for (char& letter : reference)
        if (letter == '\\') letter = '/';
    if (reference.compare(0, 7, "file://") == 0) reference = reference.substr(7);
    const std::string root = real_path(folder);
    if (root.empty() || reference.empty()) return "";

    // As written, if that stays inside.
    const std::string path = real_path(reference[0] == '/' ? reference : root + "/" + reference);
    const std::string inside = root == "/" ? root : root + "/";
    if (path.compare(0, inside.size(), inside) == 0 && is_file(path)) return path;

    // By its bare name.
    const std::string name = reference.substr(reference.rfind('/') + 1);
    if (name.empty() || name == "." || name == "..") return "";
    int entries = 0;
    return search_folder(root, name, 0, entries);
}

std::string find_beside(const std::string& folder, const std::string& reference) {
    const std::string found = find_exactly(folder, reference);
    if (!found.empty() || reference.find('%') == std::string::npos) return found;
    return find_exactly(folder, decode_uri(reference));
}

// Pictures may also lie in the folders beside the model's that are there for them: meshes/ and materials/textures/,
// source/ and textures/ are common layouts. By the bare name only, and only what ends like a picture.
static std::string find_picture(const std::string& folder, const std::string& reference) {
    const std::string found = find_beside(folder, reference);
    if (!found.empty()) return found;
    const std::string path = decode_uri(reference), name = path.substr(path.find_last_of("/\\") + 1);
    const size_t dot = name.rfind('.');
    const std::string ending = dot == std::string::npos ? "" : name.substr(dot);
    bool is_picture = false;
    for (const char* known :
         {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp", ".tif", ".tiff", ".gif", ".dds", ".psd", ".ktx2"})
        is_picture = is_picture || strcasecmp(known, ending.c_str()) == 0;
    const std::string root = real_path(folder);
    if (!is_picture || root.empty()) return "";
    int entries = 0;
    for (const char* beside : {"/../textures", "/../materials/textures", "/../texture", "/../images", "/../maps"}) {
        const std::string picture = search_folder(root + beside, name, DEEPEST_FOLDER, entries);
        if (!picture.empty()) return picture;
    }
    return "";
}

int take_texture(Surface& surface, const std::string& name, const std::string& bytes) {
    for (size_t i = 0; i < surface.textures.size(); ++i)
        if (surface.textures[i].name == name) return int(i);
    size_t all = bytes.size();
    for (const Texture& texture : surface.textures) all += texture.bytes.size();
    if (bytes.size() > LARGEST_TEXTURE || all > ALL_TEXTURES) {
        warn("the texture %s is too large (%zu MiB) and is left out", name.c_str(), bytes.size() >> 20);
        return -1;
    }
    Texture texture;
    texture.name = name;
    texture.bytes.assign(bytes.begin(), bytes.end());
    surface.textures.push_back(std::move(texture));
    return int(surface.textures.size()) - 1;
}

int take_texture_file(Surface& surface, const MeshFile& file, const std::string& reference) {
    const std::string path = find_picture(file.folder, reference);
    if (path.empty()) {
        warn("the texture %s is not in the model's folder; the material's colour is used", reference.c_str());
        return -1;
    }
    for (size_t i = 0; i < surface.textures.size(); ++i)
        if (surface.textures[i].name == reference) return int(i);
    struct stat status;
    FILE* stream = fopen(path.c_str(), "rb");
    if (!stream || fstat(fileno(stream), &status) != 0 || size_t(status.st_size) > LARGEST_TEXTURE) {
        if (stream) fclose(stream);
        warn("the texture %s is too large or cannot be read", reference.c_str());
        return -1;
    }
    std::string bytes(size_t(status.st_size), '\0');
    bytes.resize(fread(&bytes[0], 1, bytes.size(), stream));
    fclose(stream);
    if (bytes.empty()) {
        warn("the texture %s is empty", reference.c_str());
        return -1;
    }
    return take_texture(surface, reference, bytes);
}

}  // namespace frond
