// In: lines, arrows, dots, cages. Out: overlay vertices of a frame.
#include <algorithm>

#include "frame.hpp"

namespace picture {

namespace {

void store(float (&out)[3], const Frame& frame, Vec p) {
    out[0] = float(p.x - frame.origin.x), out[1] = float(p.y - frame.origin.y), out[2] = float(p.z - frame.origin.z);
}

void add_piece(Frame& frame, Vec begin, Vec end, double begin_width, double end_width, double begin_offset,
               double end_offset, frond_color color) {
    LineVertex line{};
    store(line.begin, frame, begin);
    store(line.end, frame, end);
    line.begin_width = float(begin_width), line.end_width = float(end_width);
    line.offset[0] = float(begin_offset), line.offset[1] = float(end_offset);
    line.color[0] = color.r, line.color[1] = color.g, line.color[2] = color.b, line.color[3] = color.a;
    frame.lines.push_back(line);
    frame.box.add(begin - frame.origin), frame.box.add(end - frame.origin);
}

// Returns the faces that belong to one tet only, as three corners in the tet's own order.
std::vector<std::array<int32_t, 3>> outer_faces(const int32_t* tets, const std::vector<int>& good) {
    constexpr int FACES[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    struct Face {
        std::array<int32_t, 3> key, corners;
    };
    std::vector<Face> faces;
    for (int t : good)
        for (const auto& f : FACES) {
            Face face;
            for (int c = 0; c < 3; c++) face.corners[c] = tets[4 * size_t(t) + f[c]];
            face.key = face.corners;
            std::sort(face.key.begin(), face.key.end());
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end(),
              [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.corners < b.corners; });
    std::vector<std::array<int32_t, 3>> outer;
    for (size_t i = 0; i < faces.size();) {
        size_t next = i + 1;
        while (next < faces.size() && faces[next].key == faces[i].key) next++;
        if (next == i + 1) outer.push_back(faces[i].corners);
        i = next;
    }
    return outer;
}

}  // namespace

void append_line(Frame& frame, Vec begin, Vec end, double width, frond_color color) {
    add_piece(frame, begin, end, width, width, 0, 0, color);
}

void append_arrow(Frame& frame, Vec begin, Vec end, double width, frond_color color) {
    const double head = 4.5 * width;
    add_piece(frame, begin, end, width, width, 0, -head + 0.5, color);
    add_piece(frame, begin, end, 3.6 * width, 0, -head, 0, color);
}

void append_point(Frame& frame, Vec point, double size, frond_color color) {
    PointVertex vertex{};
    store(vertex.position, frame, point);
    vertex.size = float(size);
    vertex.color[0] = color.r, vertex.color[1] = color.g, vertex.color[2] = color.b, vertex.color[3] = color.a;
    frame.points.push_back(vertex);
    frame.box.add(point - frame.origin);
}

void append_tets(Frame& frame, const double* nodes, int node_count, const int32_t* tets, int tet_count, double width,
                 frond_color line, frond_color fill) {
    const auto node = [&](int32_t i) {
        return Vec{nodes[3 * size_t(i)], nodes[3 * size_t(i) + 1], nodes[3 * size_t(i) + 2]};
    };
    // Find the tets that can be drawn.
    std::vector<int> good;
    for (int t = 0; t < tet_count; t++) {
        bool whole = true;
        for (int c = 0; c < 4; c++) {
            const int32_t i = tets[4 * size_t(t) + c];
            whole = whole && i >= 0 && i < node_count && drawable(node(i));
        }
        if (whole) good.push_back(t);
    }

    // Draw each edge once.
    if (width > 0 && line.a > 0) {
        std::vector<std::pair<int32_t, int32_t>> edges;
        for (int t : good)
            for (int a = 0; a < 4; a++)
                for (int b = a + 1; b < 4; b++)
                    edges.push_back(std::minmax({tets[4 * size_t(t) + a], tets[4 * size_t(t) + b]}));
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        for (const auto& edge : edges) append_line(frame, node(edge.first), node(edge.second), width, line);
    }

    // Draw the outer faces as flat glass.
    if (fill.a > 0) {
        MeshRun run;
        run.first_index = frame.indices.size();
        run.color = {fill.r, fill.g, fill.b, std::min(fill.a, 0.99f)};
        for (const auto& face : outer_faces(tets, good)) {
            const Vec a = node(face[0]), b = node(face[1]), c = node(face[2]);
            const Vec normal = direction(cross(b - a, c - a), {0, 1, 0});
            for (Vec p : {a, b, c}) {
                MeshVertex vertex{
                    {0, 0, 0}, {float(normal.x), float(normal.y), float(normal.z)}, {0, 0}, {255, 255, 255, 255}};
                store(vertex.position, frame, p);
                frame.indices.push_back(uint32_t(frame.vertices.size()));
                frame.vertices.push_back(vertex);
                frame.box.add(p - frame.origin);
            }
        }
        run.index_count = frame.indices.size() - run.first_index;
        if (run.index_count > 0) frame.glass.push_back(run);
    }
}

}  // namespace picture
