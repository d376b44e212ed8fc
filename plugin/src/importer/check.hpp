// Check: looks at a mesh file before assimp does, so that the usual damage gets a precise cause instead of a crash.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"

namespace frond {

enum class FileFormat { OBJ, PLY, GLTF, GLB, FBX, DAE, STL, URDF };

struct MeshFile {
    std::string path, name, folder;  // as given; without and only the folder ("." if none)
    std::string bytes;
    FileFormat format = FileFormat::OBJ;
    bool ignores_up = false;  // Collada's up axis, as URDF readers do
};

// Reads the file and tells its format by name and content. Throws FILE_FORMAT.
MeshFile open_file(const std::string& path);
void check_file(const MeshFile& file);

// One a format; they throw FILE_FORMAT with the cause, and the line where there is one.
void check_obj(const MeshFile& file);
void check_gltf(const MeshFile& file);
void check_fbx(const MeshFile& file);
void check_dae(const MeshFile& file);
void check_stl(const MeshFile& file);

}  // namespace frond
