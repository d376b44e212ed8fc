// Check: validates a mesh file before assimp reads it, so that common damage gives a precise error instead of a crash.
#pragma once

#include <string>

#include "core/error.hpp"

namespace frond {

// In the order of the rows in open_file.cpp.
enum class FileFormat { OBJ, PLY, GLTF, GLB, FBX, DAE, STL, URDF };

struct MeshFile {
    std::string path, name, folder;  // as given; file name without folder; folder alone ("." if none)
    std::string bytes;
    FileFormat format = FileFormat::OBJ;
    bool ignores_up = false;  // Collada's up axis is ignored, as URDF readers do
};

// Reads the file and finds its format by name and content. Throws FILE_FORMAT or FILE_NOT_FOUND.
MeshFile open_file(const std::string& path);
void check_file(const MeshFile& file);

// One check per format; each throws FILE_FORMAT with the cause and, where it is known, the line.
void check_obj(const MeshFile& file);
void check_gltf(const MeshFile& file);
void check_fbx(const MeshFile& file);
void check_dae(const MeshFile& file);
void check_stl(const MeshFile& file);

}  // namespace frond
