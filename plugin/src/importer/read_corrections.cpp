// Reads corrections. In: the path of a file such as corn.frond.json. Out: what it says, checked as far as it can be
// without the mesh.
//     {"unit": 0.01, "up": [0, 0, 1], "allow_stiffening": 5,
//      "organs": {"blade_3": {"kind": "fruit", "parent": "stem_1", "root": false, "leave_out": false,
//                             "material": {"young": 2e6}, "why": "...", "certainty": 0.9}}}
// All is optional; "why" and "certainty" are for people.
#include <nlohmann/json.hpp>

#include "core/platform/files.hpp"
#include "importer/importer.hpp"

namespace frond {

using OrderedJson = nlohmann::ordered_json;

namespace {

constexpr uint64_t MOST_BYTES = 16u << 20;  // [byte]

double number_in(const OrderedJson& value, const std::string& where, double least, double most) {
    if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most))
        fail(FROND_RESULT_FILE_FORMAT, "%s is %.60s; give a number from %g to %g", where.c_str(), value.dump().c_str(),
             least, most);
    return value.get<double>();
}

std::string text_in(const OrderedJson& value, const std::string& where) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        fail(FROND_RESULT_FILE_FORMAT, "%s is %.60s; give a text, or leave it out", where.c_str(),
             value.dump().c_str());
    return value.get<std::string>();
}

bool truth_in(const OrderedJson& value, const std::string& where) {
    if (!value.is_boolean())
        fail(FROND_RESULT_FILE_FORMAT, "%s is %.60s; give true or false", where.c_str(), value.dump().c_str());
    return value.get<bool>();
}

void need_object(const OrderedJson& value, const std::string& where) {
    if (!value.is_object()) fail(FROND_RESULT_FILE_FORMAT, "%s is not an object in braces", where.c_str());
}

[[noreturn]] void refuse(const std::string& key, const std::string& where, const std::string& known) {
    fail(FROND_RESULT_FILE_FORMAT, "%s has no field \"%.60s\"; it has %s", where.c_str(), key.c_str(), known.c_str());
}

Vec3 direction_in(const OrderedJson& value, const std::string& where) {
    Vec3 up = Vec3::Zero();
    if (value.is_array() && value.size() == 3)
        for (size_t k = 0; k < 3; k++) up[int(k)] = number_in(value[k], where, -1e6, 1e6);
    if (!(up.norm() > 1e-9))
        fail(FROND_RESULT_FILE_FORMAT, "%s is %.60s; give a direction such as [0, 0, 1]", where.c_str(),
             value.dump().c_str());
    return up;
}

void read_material(const OrderedJson& object, const std::string& where, OrganCorrection& organ) {
    need_object(object, where);
    for (const auto& [key, value] : object.items()) {
        std::string known;
        int found = -1;
        for (size_t i = 0; i < std::size(MATERIAL_FIELDS); i++) {
            known += (i ? ", " : "") + std::string(MATERIAL_FIELDS[i].name);
            if (key == MATERIAL_FIELDS[i].name) found = int(i);
        }
        if (found < 0) refuse(key, where, known);
        organ.material.push_back({found, number_in(value, where + "." + key, 0, 1e12)});
    }
}

OrganCorrection read_organ(const std::string& name, const OrderedJson& object) {
    const std::string where = "the organ \"" + name + "\"";
    need_object(object, where);
    OrganCorrection organ;
    organ.organ = name;
    for (const auto& [key, value] : object.items()) {
        const std::string field = where + "." + key;
        if (key == "kind")
            organ.kind = text_in(value, field);
        else if (key == "parent")
            organ.parent = text_in(value, field);
        else if (key == "root")
            organ.is_root = truth_in(value, field);
        else if (key == "leave_out")
            organ.leave_out = truth_in(value, field);
        else if (key == "material")
            read_material(value, field, organ);
        else if (key != "why" && key != "certainty")
            refuse(key, where, "kind, parent, root, leave_out, material, why, certainty");
    }
    return organ;
}

Corrections take_all(const OrderedJson& json) {
    need_object(json, "the whole");
    Corrections corrections;
    for (const auto& [key, value] : json.items()) {
        if (key == "unit") {
            corrections.unit = number_in(value, key, 1e-9, 1e9);
        } else if (key == "up") {
            corrections.up = direction_in(value, key);
        } else if (key == "allow_stiffening") {
            corrections.allow_stiffening = number_in(value, key, 1, 1e12);
        } else if (key == "organs") {
            need_object(value, key);
            for (const auto& [name, organ] : value.items()) corrections.organs.push_back(read_organ(name, organ));
        } else {
            refuse(key, "the whole", "unit, up, allow_stiffening, organs");
        }
    }
    return corrections;
}

}  // namespace

Corrections read_corrections(const std::string& path) {
    const std::string name = file_name(path);
    try {
        const FileStatus status = status_of(path);
        if (!status.exists) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", status.error.c_str());
        if (!status.is_regular) fail(FROND_RESULT_FILE_NOT_FOUND, "not a regular file");
        if (status.size > MOST_BYTES) fail(FROND_RESULT_FILE_FORMAT, "the file is larger than 16 MiB");
        std::string bytes, error;
        if (!read_file(path, status.size, bytes, error)) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", error.c_str());
        try {
            return take_all(OrderedJson::parse(bytes));
        } catch (const nlohmann::json::parse_error& damage) {
            const size_t at = std::min(bytes.size(), size_t(damage.byte));
            fail(FROND_RESULT_FILE_FORMAT, "the JSON is damaged at line %ld",
                 long(1 + std::count(bytes.begin(), bytes.begin() + long(at), '\n')));
        }
    } catch (const Error& error) {
        throw Error(error.code, name + ": " + error.what());
    }
}

}  // namespace frond
