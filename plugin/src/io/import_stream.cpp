// Writes and reads the import stream by one description of its fields. The reader trusts nothing: lengths are checked
// before memory is allocated, and a surface or tree whose indices or sizes do not agree is rejected as a whole.
#include "io/import_stream.hpp"

#include <cmath>

#include "surface/surface_fields.hpp"

namespace frond {

static constexpr char MAGIC[] = "frond-import";
static constexpr uint32_t VERSION = 5;  // of the stream; another one is of another build
static constexpr size_t NUMBER = 8;     // length and checksum of a message, before and behind it [byte]

std::string import_greeting() {
    std::string greeting(MAGIC, 12);
    greeting.append(reinterpret_cast<const char*>(&VERSION), 4);
    return greeting;
}

static void visit(Archive& a, UrdfFrame& frame) {
    a(frame.origin);
    a.numbers(frame.turn.coeffs().data(), 4);
}

static void visit(Archive& a, UrdfShape& shape) {
    auto& [kind, frame, size, mesh, material, has_color, color] = shape;
    a.one_of(kind, int(UrdfKind::MESH) + 1);
    a(frame, size, mesh, material, has_color, color);
}

static void visit(Archive& a, UrdfLink& link) {
    auto& [name, parent, joint_name, joint, frame, axis, lower, upper, effort, speed, has_inertia, mass, centre,
           inertia, visuals, collisions, organ, organ_name, organ_material, section_mass, stretching, twisting,
           bending_x, bending_y, taper] = link;
    a.one_of(joint, int(UrdfJoint::FLOATING) + 1);
    a(name, parent, joint_name, frame, axis, lower, upper, effort, speed, has_inertia, mass, centre, inertia, visuals,
      collisions, organ, organ_name, organ_material, section_mass, stretching, twisting, bending_x, bending_y, taper);
}

static void visit(Archive& a, UrdfMesh& mesh) {
    auto& [name, positions, triangles] = mesh;
    a(name, positions, triangles);
}

static void visit(Archive& a, UrdfTree& tree) {
    auto& [name, links, meshes] = tree;
    a(name, links, meshes);
}

static void visit(Archive& a, std::pair<int, double>& field_and_value) {
    auto& [field, value] = field_and_value;
    a.one_of(field, int(std::size(MATERIAL_FIELDS)));
    a(value);
}

static void visit(Archive& a, OrganCorrection& correction) {
    auto& [organ, kind, parent, material, is_root, leave_out] = correction;
    a(organ, kind, parent, material, is_root, leave_out);
}

static void visit(Archive& a, Corrections& corrections) {
    auto& [unit, up, allow_stiffening, organs] = corrections;
    a(unit, up, allow_stiffening, organs);
}

static void visit(Archive& a, ImportResult& result) {
    auto& [code, error, warnings, surface, tree, corrections] = result;
    a.one_of(code, FROND_RESULT_COUNT);
    a(error, warnings);
    if (code == FROND_OK) a(surface, tree, corrections);
}

static void append(std::string& out, uint64_t number) {
    Archive archive;
    archive(number);
    out.append(archive.out.begin(), archive.out.end());
}

std::string encode_import(ImportResult& result) {
    Archive archive;
    archive(result);
    std::string out;
    append(out, archive.out.size());
    out.append(archive.out.begin(), archive.out.end());
    append(out, checksum_by_words(archive.out.data(), archive.out.size()));
    return out;
}

// Returns whether sizes and indices agree. Defects that clean_surface() repairs are not checked here.
static bool holds_together(const Surface& surface) {
    const size_t count = surface.positions.size();
    if (surface.triangles.size() > size_t(MAX_TRIANGLES) || count > size_t(3) * MAX_TRIANGLES) return false;
    if (!surface.normals.empty() && surface.normals.size() != count) return false;
    if (!surface.uvs.empty() && surface.uvs.size() != count) return false;
    if (!surface.colors.empty() && surface.colors.size() != count) return false;
    for (const Triangle& triangle : surface.triangles)
        for (int corner : triangle)
            if (corner < 0 || size_t(corner) >= count) return false;
    int64_t covered = 0;
    for (const Part& part : surface.parts) {
        if (part.first_triangle != covered || part.triangle_count < 0) return false;
        covered += part.triangle_count;
        if (part.texture < -1 || part.texture >= int(surface.textures.size()) || part.organ != -1) return false;
        for (float channel : part.color)
            if (!(channel >= 0 && channel <= 1)) return false;
    }
    return covered == int64_t(surface.triangles.size()) && surface.dropped_triangles >= 0 &&
           surface.repaired_vertices == 0 && !surface.placed && surface.scale > 0 && surface.scale < 1e30 &&
           surface.up.allFinite() && std::abs(surface.up.norm() - 1) < 1e-6;
}

static bool holds_together(const Corrections& corrections) {
    return corrections.unit >= 0 && std::isfinite(corrections.unit) && corrections.up.allFinite() &&
           corrections.allow_stiffening >= 0;
}

bool decode_import(const char* bytes, size_t byte_count, ImportResult& result) {
    if (byte_count < 2 * NUMBER) return false;
    const size_t length = byte_count - 2 * NUMBER;
    std::string head, tail;
    append(head, length);
    const auto* content = reinterpret_cast<const uint8_t*>(bytes) + NUMBER;
    append(tail, checksum_by_words(content, length));
    if (head.compare(0, NUMBER, bytes, NUMBER) != 0 || tail.compare(0, NUMBER, bytes + NUMBER + length, NUMBER) != 0)
        return false;
    Archive archive(content, length, {"the import stream", "build Frond and frond-import anew"});
    try {
        archive(result);
    } catch (const Error&) {
        return false;
    }
    if (!archive.is_at_end()) return false;
    return result.code != FROND_OK || (holds_together(result.surface) && holds_together(result.corrections) &&
                                       (result.tree.links.empty() || what_is_wrong_with(result.tree).empty()));
}

}  // namespace frond
