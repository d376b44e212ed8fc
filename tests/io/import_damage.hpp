// What the tests of damaged files share.
#pragma once

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import_files.hpp"
#include "io/import_process.hpp"

namespace import_damage_tests {

using namespace frond;

struct Quiet : testing::Test {
    void SetUp() override { set_log(nullptr, nullptr); }
};
using ImportDamage = Quiet;

struct Sample {
    const char* name;
    std::string bytes;
};

inline std::vector<Sample> samples() {
    return {{"a.obj", files::obj()},      {"t.ply", files::ply(false)}, {"b.ply", files::ply(true)},
            {"t.stl", files::stl(false)}, {"b.stl", files::stl(true)},  {"a.glb", files::glb()},
            {"a.dae", files::dae(true)},  {"t.fbx", files::fbx(false)}, {"b.fbx", files::fbx(true)}};
}

inline std::string error_of(const std::string& path) {
    try {
        import_surface(path, {});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace import_damage_tests
