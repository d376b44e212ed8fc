// What a file declares about its unit and axes. In: assimp's scene and the file. Out: Surface::scale and up.
#include <assimp/scene.h>

#include <map>
#include <sstream>

#include "core/decompose.hpp"
#include "importer/importer.hpp"

namespace frond {

static double double_of(const aiMetadata* data, const char* key, double missing) {
    double value;
    float small;
    if (data && data->Get(key, value)) return value;
    if (data && data->Get(key, small)) return double(small);
    return missing;
}

static int int_of(const aiMetadata* data, const char* key, int missing) {
    int32_t value;
    return data && data->Get(key, value) ? int(value) : missing;
}

// Returns the number in <unit meter="0.01"/>.
static double unit_of_dae(const std::string& bytes) {
    const size_t unit = bytes.find("<unit"), end = bytes.find('>', unit == std::string::npos ? 0 : unit);
    if (unit == std::string::npos || end == std::string::npos) return 1;
    const size_t meter = bytes.find("meter=", unit);
    if (meter == std::string::npos || meter > end) return 1;
    const double value = strtod(bytes.c_str() + meter + 7, nullptr);
    return value > 1e-20 && value < 1e20 ? value : 1;
}

// Returns the unit that an OBJ file's comments state, as some programs write it ("## File units = inches") [m]; 0:
// none.
static double unit_of_obj(const std::string& bytes) {
    constexpr size_t HEADER = 4096;  // where programs write it [byte]
    static const std::map<std::string, double> UNITS = {
        {"millimeters", 1e-3}, {"millimetres", 1e-3}, {"centimeters", 1e-2}, {"centimetres", 1e-2}, {"meters", 1},
        {"metres", 1},         {"inches", 0.0254},    {"feet", 0.3048},      {"mm", 1e-3},          {"cm", 1e-2}};
    std::istringstream header(bytes.substr(0, HEADER));
    for (std::string line; std::getline(header, line);) {
        if (line.empty() || line[0] != '#') continue;
        for (char& letter : line) letter = isalpha(uint8_t(letter)) ? char(tolower(uint8_t(letter))) : ' ';
        std::istringstream words(line);
        bool names_unit = false;
        double found = 0;
        for (std::string word; words >> word;) {
            names_unit = names_unit || word == "unit" || word == "units";
            for (const std::string& name : {word, word + "s", word + "es"})
                if (const auto unit = UNITS.find(name); unit != UNITS.end()) found = unit->second;
        }
        if (names_unit && found > 0) return found;
    }
    return 0;
}

Eigen::Matrix4d take_frame(const aiScene& scene, const MeshFile& file, Surface& surface) {
    Eigen::Matrix4d frame = Eigen::Matrix4d::Identity();
    surface.up_declared = surface.scale_declared = true;
    if (file.format == FileFormat::FBX) {
        const double unit = double_of(scene.mMetaData, "UnitScaleFactor", 1) * 0.01;
        surface.scale = unit > 1e-20 && unit < 1e20 ? unit : 0.01;
        const int axis = int_of(scene.mMetaData, "UpAxis", 1), sign = int_of(scene.mMetaData, "UpAxisSign", 1);
        if (axis >= 0 && axis < 3) surface.up = Vec3::Unit(axis) * (sign < 0 ? -1 : 1);
        frame.topLeftCorner<3, 3>() = surface.scale * turn_between(surface.up, Vec3::UnitY()).toRotationMatrix();
    } else if (file.format == FileFormat::DAE) {
        surface.scale = unit_of_dae(file.bytes);
        if (file.bytes.find("<up_axis>Z_UP") != std::string::npos) surface.up = Vec3::UnitZ();
        if (file.bytes.find("<up_axis>X_UP") != std::string::npos) surface.up = Vec3::UnitX();
    } else if (file.format != FileFormat::GLTF && file.format != FileFormat::GLB) {
        surface.up_declared = false;
        surface.scale_declared = false;
    }
    const double unit = file.format == FileFormat::OBJ ? unit_of_obj(file.bytes) : 0;
    if (unit > 0) {
        surface.scale = unit;
        surface.scale_declared = true;
        frame.topLeftCorner<3, 3>() *= unit;
    }
    return frame;
}

}  // namespace frond
