// Writes and reads the import stream. The reader trusts nothing: lengths are checked before memory is allocated, and a
// surface or tree whose indices or sizes do not agree is rejected as a whole.
#include "io/import_stream.hpp"

#include "io/byte_stream.hpp"

namespace frond {

static constexpr char MAGIC[] = "frond-import";
static constexpr uint32_t VERSION = 4;  // of the stream; another one is of another build
// More is damage.
static constexpr uint32_t MAX_PARTS = 1000000, MAX_TEXTURES = 10000, MAX_WARNINGS = 1000, MAX_CORRECTIONS = 100000;

std::string import_greeting() {
    std::string greeting(MAGIC, 12);
    greeting.append(reinterpret_cast<const char*>(&VERSION), 4);
    return greeting;
}

// Checksum over 8-byte words, against truncated and mixed-up streams, not against forged ones.
static uint64_t checksum(const char* bytes, size_t count) {
    uint64_t sum = 0xCBF29CE484222325ull ^ count;
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        uint64_t word;
        std::memcpy(&word, bytes + i, 8);
        sum = (sum ^ word) * 0x9E3779B97F4A7C15ull;
        sum ^= sum >> 31;
    }
    for (; i < count; ++i) sum = (sum ^ uint8_t(bytes[i])) * 0x100000001B3ull;
    return sum;
}

static void put_surface(std::string& out, const Surface& surface) {
    put_array(out, surface.positions);
    put_array(out, surface.normals);
    put_array(out, surface.uvs);
    put_array(out, surface.colors);
    put_array(out, surface.triangles);
    put(out, uint32_t(surface.parts.size()));
    for (const Part& part : surface.parts) {
        put_text(out, part.name);
        put_text(out, part.material);
        put(out, part.color);
        put(out, int32_t(part.texture));
        put(out, int32_t(part.first_triangle));
        put(out, int32_t(part.triangle_count));
    }
    put(out, uint32_t(surface.textures.size()));
    for (const Texture& texture : surface.textures) {
        put_text(out, texture.name);
        put_array(out, texture.bytes);
    }
    put(out, surface.scale);
    for (int axis = 0; axis < 3; ++axis) put(out, double(surface.up[axis]));
    put(out, uint8_t(surface.up_declared));
    put(out, uint8_t(surface.scale_declared));
    put(out, int32_t(surface.dropped_triangles));
}

static void put_corrections(std::string& out, const Corrections& corrections) {
    put(out, corrections.unit);
    for (int axis = 0; axis < 3; ++axis) put(out, double(corrections.up[axis]));
    put(out, corrections.allow_stiffening);
    put(out, uint32_t(corrections.organs.size()));
    for (const OrganCorrection& one : corrections.organs) {
        put_text(out, one.organ);
        put_text(out, one.kind);
        put_text(out, one.parent);
        put(out, uint32_t(one.material.size()));
        for (const auto& [field, value] : one.material) {
            put(out, int32_t(field));
            put(out, value);
        }
        put(out, uint8_t(one.is_root));
        put(out, uint8_t(one.leave_out));
    }
}

std::string encode_import(const ImportResult& result) {
    const Surface& surface = result.surface;
    std::string out(8, '\0');
    out.reserve(1024 + surface.positions.size() * 48 + surface.triangles.size() * 12);
    put(out, uint32_t(result.code));
    put_text(out, result.error);
    put(out, uint32_t(std::min<size_t>(result.warnings.size(), MAX_WARNINGS)));
    for (size_t i = 0; i < result.warnings.size() && i < MAX_WARNINGS; ++i) put_text(out, result.warnings[i]);
    if (result.code == FROND_OK) {
        put_surface(out, surface);
        put_tree(out, result.tree);
        put_corrections(out, result.corrections);
    }
    const uint64_t length = out.size() - 8;
    std::memcpy(&out[0], &length, 8);
    put(out, checksum(out.data() + 8, size_t(length)));
    return out;
}

static void take_surface(StreamReader& in, Surface& surface) {
    take_array(in, surface.positions);
    take_array(in, surface.normals);
    take_array(in, surface.uvs);
    take_array(in, surface.colors);
    take_array(in, surface.triangles);
    const uint32_t part_count = take<uint32_t>(in);
    in.good = in.good && part_count <= MAX_PARTS;
    for (uint32_t i = 0; in.good && i < part_count; ++i) {
        Part part;
        part.name = take_text(in);
        part.material = take_text(in);
        part.color = take<std::array<float, 4>>(in);
        part.texture = take<int32_t>(in);
        part.first_triangle = take<int32_t>(in);
        part.triangle_count = take<int32_t>(in);
        surface.parts.push_back(std::move(part));
    }
    const uint32_t texture_count = take<uint32_t>(in);
    in.good = in.good && texture_count <= MAX_TEXTURES;
    for (uint32_t i = 0; in.good && i < texture_count; ++i) {
        Texture texture;
        texture.name = take_text(in);
        take_array(in, texture.bytes);
        surface.textures.push_back(std::move(texture));
    }
    surface.scale = take<double>(in);
    for (int axis = 0; axis < 3; ++axis) surface.up[axis] = take<double>(in);
    surface.up_declared = take<uint8_t>(in) != 0;
    surface.scale_declared = take<uint8_t>(in) != 0;
    surface.dropped_triangles = take<int32_t>(in);
}

static void take_corrections(StreamReader& in, Corrections& corrections) {
    corrections.unit = take<double>(in);
    for (int axis = 0; axis < 3; ++axis) corrections.up[axis] = take<double>(in);
    corrections.allow_stiffening = take<double>(in);
    in.good = in.good && corrections.unit >= 0 && std::isfinite(corrections.unit) && corrections.up.allFinite() &&
              corrections.allow_stiffening >= 0;
    const uint32_t count = take<uint32_t>(in);
    in.good = in.good && count <= MAX_CORRECTIONS;
    for (uint32_t i = 0; in.good && i < count; ++i) {
        OrganCorrection one;
        one.organ = take_text(in);
        one.kind = take_text(in);
        one.parent = take_text(in);
        const uint32_t fields = take<uint32_t>(in);
        in.good = in.good && fields <= MATERIAL_FIELD_COUNT;
        for (uint32_t k = 0; in.good && k < fields; ++k) {
            const int32_t field = take<int32_t>(in);
            in.good = in.good && field >= 0 && size_t(field) < MATERIAL_FIELD_COUNT;
            one.material.push_back({field, take<double>(in)});
        }
        one.is_root = take<uint8_t>(in) != 0;
        one.leave_out = take<uint8_t>(in) != 0;
        corrections.organs.push_back(std::move(one));
    }
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
        if (part.texture < -1 || part.texture >= int(surface.textures.size())) return false;
        for (float channel : part.color)
            if (!(channel >= 0 && channel <= 1)) return false;
    }
    return covered == int64_t(surface.triangles.size()) && surface.dropped_triangles >= 0 && surface.scale > 0 &&
           surface.scale < 1e30 && surface.up.allFinite() && std::abs(surface.up.norm() - 1) < 1e-6;
}

bool decode_import(const char* bytes, size_t byte_count, ImportResult& result) {
    StreamReader in{bytes, byte_count};
    const uint64_t length = take<uint64_t>(in);
    if (!in.good || byte_count < 16 || length != byte_count - 16) return false;
    uint64_t sum;
    std::memcpy(&sum, bytes + 8 + length, 8);
    if (sum != checksum(bytes + 8, size_t(length))) return false;
    in.left -= 8;

    const uint32_t code = take<uint32_t>(in);
    if (code >= uint32_t(FROND_RESULT_COUNT)) return false;
    result.code = frond_result(code);
    result.error = take_text(in);
    const uint32_t warning_count = take<uint32_t>(in);
    if (!in.good || warning_count > MAX_WARNINGS) return false;
    for (uint32_t i = 0; in.good && i < warning_count; ++i) result.warnings.push_back(take_text(in));
    if (in.good && result.code == FROND_OK) {
        take_surface(in, result.surface);
        if (in.good && !holds_together(result.surface)) return false;
        take_tree(in, result.tree);
        if (in.good && !result.tree.links.empty() && !what_is_wrong_with(result.tree).empty()) return false;
        take_corrections(in, result.corrections);
    }
    return in.good && in.left == 0;
}

}  // namespace frond
