// Finds and reads the files that a model refers to. Only files in the model's folder are opened, and pictures in the
// texture folders beside it. For a path that leads elsewhere, the bare file name is searched for instead: artists'
// files are full of paths from other machines.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>

#include "core/log.hpp"
#include "core/platform/files.hpp"
#include "importer/importer.hpp"

namespace frond {

static constexpr size_t LARGEST_TEXTURE = size_t(128) << 20, ALL_TEXTURES = size_t(768) << 20;  // [byte]
static constexpr int DEEPEST_FOLDER = 4, MOST_ENTRIES = 20000;  // bounds on listing a folder that is no model's own

// Files of a folder and its subfolders, in the order in which they were listed.
struct Listing {
    std::vector<std::string> paths;
    std::map<std::string, std::vector<size_t>> by_name;  // name in lower case -> paths
};

static std::string lower(std::string text) {
    for (char& letter : text) letter = char(tolower(uint8_t(letter)));
    return text;
}

// Lists a folder before its subfolders; links to folders are not followed.
static void list_folder(const std::string& folder, int depth, int& entries, Listing& listing) {
    std::vector<std::string> below;
    const std::vector<FolderEntry> found = entries_of(folder, size_t(MOST_ENTRIES - entries));
    entries += int(found.size());
    for (const FolderEntry& entry : found) {
        const std::string path = folder + "/" + entry.name;
        if (entry.name[0] == '.') continue;
        if (entry.is_folder) below.push_back(path);
        if (!entry.is_regular) continue;
        listing.by_name[lower(entry.name)].push_back(listing.paths.size());
        listing.paths.push_back(path);
    }
    for (size_t i = 0; depth < DEEPEST_FOLDER && i < below.size(); ++i)
        list_folder(below[i], depth + 1, entries, listing);
}

// Searches a folder, down to a depth, for a file name; one of the same case comes first. Each folder is listed once.
static std::string search_folder(const std::string& folder, const std::string& name, int depth) {
    static std::map<std::pair<std::string, int>, Listing> known;
    const auto [at, is_new] = known.try_emplace({folder, depth});
    int entries = 0;
    if (is_new) list_folder(folder, depth, entries, at->second);
    const auto found = at->second.by_name.find(lower(name));
    if (found == at->second.by_name.end()) return "";
    const std::vector<std::string>& paths = at->second.paths;
    for (size_t i : found->second)
        if (paths[i].compare(paths[i].size() - name.size(), name.size(), name) == 0) return paths[i];
    return paths[found->second.front()];
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

    // The path as written, if it stays inside the folder.
    const std::string path = real_path(is_absolute(reference) ? reference : root + "/" + reference);
    const std::string inside = root == "/" ? root : root + "/";
    if (path.compare(0, inside.size(), inside) == 0 && is_regular_file(path)) return path;

    // Else by the bare file name.
    const std::string name = reference.substr(reference.rfind('/') + 1);
    if (name.empty() || name == "." || name == "..") return "";
    return search_folder(root, name, 0);
}

std::string find_beside(const std::string& folder, const std::string& reference) {
    const std::string found = find_exactly(folder, reference);
    if (!found.empty() || reference.find('%') == std::string::npos) return found;
    return find_exactly(folder, decode_uri(reference));
}

// ---- pictures ----

static const char* const PICTURE_FOLDERS[] = {
    "/textures",    "/materials/textures",    "/texture",    "/images",    "/maps",
    "/../textures", "/../materials/textures", "/../texture", "/../images", "/../maps"};

// Returns the file name in lower case without its ending: "Work/Leaf.PNG" -> "leaf". The ending, with the dot, goes to
// `ending`.
static std::string stem_of(const std::string& path, std::string& ending) {
    std::string name = path.substr(path.find_last_of("/\\") + 1);
    for (char& letter : name) letter = char(tolower(uint8_t(letter)));
    const size_t dot = name.rfind('.');
    ending = dot == std::string::npos ? "" : name.substr(dot);
    return name.substr(0, dot);
}

// Returns whether a file with that ending can be drawn.
static bool is_drawable(const std::string& ending) {
    for (const char* known : {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp"})
        if (ending == known) return true;
    return false;
}

static bool is_picture(const std::string& ending) {
    for (const char* known : {".tif", ".tiff", ".gif", ".dds", ".psd", ".exr", ".ktx2"})
        if (ending == known) return true;
    return is_drawable(ending);
}

// Lists the drawable pictures in the model's folder and in the texture folders in and beside it, nearest first; once.
static const std::vector<std::string>& list_pictures(const std::string& folder) {
    static std::map<std::string, std::vector<std::string>> known;
    const auto [at, is_new] = known.try_emplace(folder);
    std::vector<std::string>& pictures = at->second;
    if (!is_new) return pictures;
    std::vector<std::string> folders = {""};
    folders.insert(folders.end(), std::begin(PICTURE_FOLDERS), std::end(PICTURE_FOLDERS));
    int entries = 0;
    for (const std::string& near : folders) {
        const size_t first = pictures.size();
        const std::vector<FolderEntry> found = entries_of(folder + near, size_t(MOST_ENTRIES - entries));
        entries += int(found.size());
        for (const FolderEntry& entry : found) {
            std::string ending;
            stem_of(entry.name, ending);
            if (entry.is_regular && is_drawable(ending)) pictures.push_back(folder + near + "/" + entry.name);
        }
        std::sort(pictures.begin() + long(first), pictures.end());
    }
    return pictures;
}

// Finds a picture, also in the texture folders in and beside the model's (common layouts: meshes/ with
// materials/textures/, source/ with textures/). There it is searched for by its bare name only, and only with a
// picture's ending. One that is missing or cannot be drawn is replaced by one of the same name in another format.
static std::string find_picture(const std::string& folder, const std::string& reference) {
    const std::string path = decode_uri(reference), name = path.substr(path.find_last_of("/\\") + 1);
    std::string ending, other;
    const std::string stem = stem_of(name, ending), root = real_path(folder);
    std::string found = find_beside(folder, reference);
    if (root.empty() || !is_picture(ending) || (!found.empty() && is_drawable(ending))) return found;
    for (const char* near : PICTURE_FOLDERS)
        if (found.empty()) found = search_folder(root + near, name, DEEPEST_FOLDER);
    if (!found.empty() && is_drawable(ending)) return found;
    for (const std::string& picture : list_pictures(root))
        if (stem_of(picture, other) == stem) return picture;
    return found;
}

// Keeps letters and digits only, in lower case: "Branch 2_diffuse" -> "branch2diffuse".
static std::string squeeze(const std::string& text) {
    std::string out;
    for (char letter : text)
        if (isalnum(uint8_t(letter)) || uint8_t(letter) >= 0x80) out += char(tolower(uint8_t(letter)));
    return out;
}

// Returns whether a picture has the other name, alone or with a suffix that marks a colour texture.
static bool is_named_after(const std::string& picture, const std::string& name) {
    if (name.empty() || picture.compare(0, name.size(), name) != 0) return false;
    const std::string rest = picture.substr(name.size());
    for (const char* mark : {"", "d", "c", "col", "color", "colour", "diff", "diffuse", "albedo", "base", "basecolor",
                             "tex", "texture", "map"})
        if (rest == mark) return true;
    return false;
}

int guess_texture(Surface& surface, const MeshFile& file, const std::string& material) {
    const std::string root = real_path(file.folder);
    if (root.empty()) return -1;
    std::string ending, whole = squeeze(material), base = whole;
    while (!base.empty() && isdigit(uint8_t(base.back()))) base.pop_back();  // "Bark_001" counts as "Bark"
    const std::vector<std::string>& pictures = list_pictures(root);
    for (const std::string& name : {whole, base, squeeze(stem_of(file.name, ending))})
        for (const std::string& picture : pictures) {
            if (!is_named_after(squeeze(stem_of(picture, ending)), name)) continue;
            const std::string bare = picture.substr(picture.rfind('/') + 1);
            warn("the material \"%s\" names no texture that is there; %s is taken by its name", material.c_str(),
                 bare.c_str());
            return take_texture_file(surface, file, bare);
        }
    return -1;
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
    std::string bytes, error;
    if (status_of(path).size > LARGEST_TEXTURE || !read_file(path, LARGEST_TEXTURE, bytes, error)) {
        warn("the texture %s is too large or cannot be read", reference.c_str());
        return -1;
    }
    if (bytes.empty()) {
        warn("the texture %s is empty", reference.c_str());
        return -1;
    }
    return take_texture(surface, reference, bytes);
}

}  // namespace frond
