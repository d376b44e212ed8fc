// Urdf reading: XML text -> urdfdom's model -> UrdfTree. What urdfdom drops without a word (capsules, elements that it
// does not know, numbers that it cannot read) is found in the same text beside it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "importer/check.hpp"
#include "model/urdf.hpp"

namespace frond {

// The contents of a link's element.
struct UrdfNotes {
    int line = 0;
    std::vector<bool> visual_capsules, collision_capsules;  // one a geometry: it is a capsule
    bool has_inertial = false;
    UrdfLink of_frond;  // only what the element <frond> says
};

// A file that urdfdom can be trusted with.
struct UrdfText {
    std::string xml;  // capsules are written as cylinders
    std::map<std::string, UrdfNotes> links;
};

// Throws FILE_FORMAT with the line unless the text is one tree of links and joints of sizes that can be read.
UrdfText check_urdf(const MeshFile& file);
UrdfTree read_urdf(const MeshFile& file, UrdfUse use);

// The path of the mesh that a URDF file in `folder` names. "package://NAME/PATH" is PATH in the folder NAME, or one
// that holds NAME's package.xml, of those in FROND_PACKAGE_PATH or ROS_PACKAGE_PATH (separated by colons), else of
// those above `folder`, nearest first; any other path is taken from `folder`. Throws FILE_NOT_FOUND with what was
// looked for.
std::string find_mesh(const std::string& folder, const std::string& reference);

}  // namespace frond
