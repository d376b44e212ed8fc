// Organs, their parts. In: a shape (rings, sheet, hair). Out: vertices and triangles of the organ begun last.
#include "organs.hpp"

namespace frond::grow {

int add_material(GrownPlant& plant, const std::string& name, Rgb color, const std::string& texture) {
    plant.materials.push_back({name, {color.r, color.g, color.b}, texture});
    return static_cast<int>(plant.materials.size()) - 1;
}

void begin_organ(GrownPlant& plant, const std::string& name, int material) {
    plant.organs.push_back(
        {name, material, static_cast<int>(plant.positions.size()), 0, static_cast<int>(plant.triangles.size()), 0});
}

int add_vertex(GrownPlant& plant, Vec p, Rgb color, double u, double v) {
    plant.positions.push_back({p.x, p.y, p.z});
    plant.colors.push_back({clamp01(color.r), clamp01(color.g), clamp01(color.b)});
    plant.uvs.push_back({u, v});
    plant.organs.back().vertex_count++;
    return static_cast<int>(plant.positions.size()) - 1;
}

void add_triangle(GrownPlant& plant, int a, int b, int c) {
    plant.triangles.push_back({a, b, c});
    plant.organs.back().triangle_count++;
}

Vec position_of(const GrownPlant& plant, int vertex) {
    const auto& p = plant.positions[vertex];
    return {p[0], p[1], p[2]};
}

TubeMesh add_tube(GrownPlant& plant, const Tube& tube) {
    const int rings = static_cast<int>(tube.rings.size()), sides = tube.sides;
    auto center = [&](int r) { return tube.rings[std::min(std::max(r, 0), rings - 1)].center; };
    auto tint = [&](int r, int s) { return tube.tint ? tube.tint(r, s) : tube.rings[r].color; };

    // Carry a frame along the curve without twist.
    Vec along = unit(center(1) - center(0));
    Vec side = unit(std::fabs(along.y) < 0.9 ? cross(along, {0, 1, 0}) : cross(along, {0, 0, 1}));
    side = turned(side, along, tube.roll);
    TubeMesh mesh{0, sides, rings, {}};
    int start = -1;
    if (tube.close_start) start = add_vertex(plant, center(0) - tube.start_reach * along, tint(0, 0));
    mesh.first = static_cast<int>(plant.positions.size());
    for (int r = 0; r < rings; r++) {
        const Vec next = unit(center(r + 1) - center(r - 1));
        side = unit(side - dot(side, next) * next);
        along = next;
        const Vec up = cross(along, side);
        mesh.centers.push_back(center(r));
        for (int s = 0; s < sides; s++) {
            const double angle = TURN * s / sides;
            const double radius = tube.rings[r].radius * (tube.bulge ? tube.bulge(r, s) : 1.0);
            add_vertex(plant, center(r) + (radius * std::cos(angle)) * side + (radius * std::sin(angle)) * up,
                       tint(r, s));
        }
    }

    // Skin between the rings, then fans over the closed ends; normals point outwards.
    for (int s = 0; start >= 0 && s < sides; s++) add_triangle(plant, start, mesh.at(0, s + 1), mesh.at(0, s));
    for (int r = 0; r + 1 < rings; r++) {
        for (int s = 0; s < sides; s++) {
            add_triangle(plant, mesh.at(r, s), mesh.at(r, s + 1), mesh.at(r + 1, s + 1));
            add_triangle(plant, mesh.at(r, s), mesh.at(r + 1, s + 1), mesh.at(r + 1, s));
        }
    }
    if (tube.close_end) {
        const int end = add_vertex(plant, center(rings - 1) + tube.end_reach * along, tint(rings - 1, 0));
        for (int s = 0; s < sides; s++) add_triangle(plant, mesh.at(rings - 1, s), mesh.at(rings - 1, s + 1), end);
    }
    return mesh;
}

int add_sheet(GrownPlant& plant, const Sheet& sheet) {
    const int first = static_cast<int>(plant.positions.size());
    auto put = [&](int r, int c) {
        const std::array<double, 2> uv = sheet.map ? sheet.map(r, c) : std::array<double, 2>{0, 0};
        add_vertex(plant, sheet.place(r, c), sheet.tint(r, c), uv[0], uv[1]);
    };
    for (int r = 0; r < sheet.rows; r++)
        for (int c = 0; c < sheet.columns; c++) put(r, c);
    for (int r = 0; r + 1 < sheet.rows; r++) {
        for (int c = 0; c + 1 < sheet.columns; c++) {
            // The diagonal is mirrored about the middle, so that both halves bend alike.
            const int a = first + r * sheet.columns + c, b = a + 1, d = a + sheet.columns, e = d + 1;
            if (2 * c + 1 < sheet.columns) {
                add_triangle(plant, a, b, e), add_triangle(plant, a, e, d);
            } else {
                add_triangle(plant, a, b, d), add_triangle(plant, b, e, d);
            }
        }
    }
    if (sheet.pointed) {
        put(sheet.rows, sheet.columns / 2);
        const int last = first + (sheet.rows - 1) * sheet.columns, point = first + sheet.rows * sheet.columns;
        for (int c = 0; c + 1 < sheet.columns; c++) add_triangle(plant, last + c, last + c + 1, point);
    }
    return first;
}

void add_hair(GrownPlant& plant, int skin_vertex, Vec out, Vec along, double height, double width, bool curved,
              Rgb color) {
    const Vec foot = position_of(plant, skin_vertex);
    if (!curved) {
        const int other = add_vertex(plant, foot + width * along, color);
        const int tip = add_vertex(plant, foot + (0.5 * width) * along + height * out, color);
        add_triangle(plant, skin_vertex, other, tip);
        return;
    }
    const int other = add_vertex(plant, foot + width * along, color);
    const int knee = add_vertex(plant, foot + (0.1 * width) * along + (0.6 * height) * out, color);
    const int tip = add_vertex(plant, foot + (0.3 * height) * along + height * out, color);
    add_triangle(plant, skin_vertex, other, knee);
    add_triangle(plant, other, tip, knee);
}

void fill_palette(GrownImage& image, Rgb low, Rgb high) {
    auto byte = [](double share) { return static_cast<uint8_t>(std::lround(255 * clamp01(share))); };
    for (int i = 0; i < 256; i++) {
        const Rgb c = mix(low, high, i / 255.0);
        image.palette.push_back({byte(c.r / high.r), byte(c.g / high.g), byte(c.b / high.b)});
    }
}

std::vector<Vec> curve_through(const std::vector<Vec>& control, int count) {
    const int last = static_cast<int>(control.size()) - 1;
    auto at = [&](int i) {
        if (i < 0) return 2.0 * control[0] - control[1];
        if (i > last) return 2.0 * control[last] - control[last - 1];
        return control[i];
    };
    std::vector<Vec> points;
    for (int k = 0; k < count; k++) {
        const double u = static_cast<double>(k) * last / (count - 1);
        const int i = std::min(static_cast<int>(u), last - 1);
        const double t = u - i, t2 = t * t, t3 = t2 * t;
        points.push_back(0.5 * ((2.0 * at(i)) + t * (at(i + 1) - at(i - 1)) +
                                t2 * (2.0 * at(i - 1) - 5.0 * at(i) + 4.0 * at(i + 1) - at(i + 2)) +
                                t3 * (3.0 * at(i) - at(i - 1) - 3.0 * at(i + 1) + at(i + 2))));
    }
    return points;
}

}  // namespace frond::grow
