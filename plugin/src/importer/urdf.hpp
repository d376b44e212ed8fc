// URDF reading: XML text -> urdfdom's model -> UrdfTree. Data that urdfdom drops silently (capsules, elements that it
// does not know, numbers that it cannot read) are taken from the same text separately.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "importer/check.hpp"
#include "io/urdf.hpp"

namespace frond {

// Notes on the contents of a link's element.
struct UrdfNotes {
    int line = 0;
    std::vector<bool> visual_capsules, collision_capsules;  // for each geometry whether it is a capsule
    bool has_inertial = false;
    UrdfLink of_frond;  // only the values of the element <frond>
};

// A file that is safe for urdfdom.
struct UrdfText {
    std::string xml;  // capsules are written as cylinders
    std::map<std::string, UrdfNotes> links;
};

// Checks that the text is one tree of links and joints within the size limits; else throws FILE_FORMAT with the line.
UrdfText check_urdf(const MeshFile& file);
UrdfTree read_urdf(const MeshFile& file, UrdfUse use);

// Returns the path of a mesh that a URDF file in `folder` names. "package://NAME/PATH" is searched for in the folders
// in FROND_PACKAGE_PATH and ROS_PACKAGE_PATH (separated by colons), then in `folder` and those above it, nearest first:
// as NAME/PATH, or as PATH in a folder that holds a package.xml. Any other relative path starts at `folder`. Throws
// FILE_NOT_FOUND with what was searched for.
std::string find_mesh(const std::string& folder, const std::string& reference);

}  // namespace frond
