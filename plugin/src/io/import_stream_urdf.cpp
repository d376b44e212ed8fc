// Trees of links in the import stream.
#include "io/byte_stream.hpp"

namespace frond {

static constexpr uint32_t MOST_MESHES = 10000;  // more is damage

static void put_vec(std::string& out, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) put(out, double(v[axis]));
}

static void put_frame(std::string& out, const UrdfFrame& frame) {
    put_vec(out, frame.origin);
    for (int i = 0; i < 4; ++i) put(out, double(frame.turn.coeffs()[i]));
}

static void put_shapes(std::string& out, const std::vector<UrdfShape>& shapes) {
    put(out, uint32_t(shapes.size()));
    for (const UrdfShape& shape : shapes) {
        put(out, int32_t(shape.kind));
        put_frame(out, shape.frame);
        put_vec(out, shape.size);
        put(out, int32_t(shape.mesh));
        put_text(out, shape.material);
        put(out, uint8_t(shape.has_color));
        put(out, shape.color);
    }
}

void put_tree(std::string& out, const UrdfTree& tree) {
    put_text(out, tree.name);
    put(out, uint32_t(tree.links.size()));
    for (const UrdfLink& link : tree.links) {
        for (const std::string* text :
             {&link.name, &link.joint_name, &link.organ, &link.organ_name, &link.organ_material})
            put_text(out, *text);
        put(out, int32_t(link.parent));
        put(out, int32_t(link.joint));
        put_frame(out, link.frame);
        put_vec(out, link.axis);
        for (double value : {link.lower, link.upper, link.effort, link.speed, link.mass, link.section_mass,
                             link.stretching, link.twisting, link.bending_x, link.bending_y, link.taper})
            put(out, value);
        put(out, uint8_t(link.has_inertia));
        put_frame(out, link.centre);
        for (int axis = 0; axis < 3; ++axis) put_vec(out, link.inertia.col(axis));
        put_shapes(out, link.visuals);
        put_shapes(out, link.collisions);
    }
    put(out, uint32_t(tree.meshes.size()));
    for (const UrdfMesh& mesh : tree.meshes) {
        put_text(out, mesh.name);
        put_array(out, mesh.positions);
        put_array(out, mesh.triangles);
    }
}

static Vec3 take_vec(StreamReader& in) {
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = take<double>(in);
    return v;
}

static UrdfFrame take_frame(StreamReader& in) {
    UrdfFrame frame;
    frame.origin = take_vec(in);
    for (int i = 0; i < 4; ++i) frame.turn.coeffs()[i] = take<double>(in);
    return frame;
}

// Reads the number of items that follow one by one.
static uint32_t take_count(StreamReader& in, uint32_t most) {
    const uint32_t count = take<uint32_t>(in);
    in.good = in.good && count <= most;
    return in.good ? count : 0;
}

static void take_shapes(StreamReader& in, std::vector<UrdfShape>& shapes) {
    const uint32_t count = take_count(in, MOST_SHAPES);
    for (uint32_t i = 0; in.good && i < count; ++i) {
        UrdfShape shape;
        const int32_t kind = take<int32_t>(in);
        in.good = in.good && kind >= 0 && kind <= int32_t(UrdfKind::MESH);
        shape.kind = UrdfKind(in.good ? kind : 0);
        shape.frame = take_frame(in);
        shape.size = take_vec(in);
        shape.mesh = take<int32_t>(in);
        shape.material = take_text(in);
        shape.has_color = take<uint8_t>(in) != 0;
        shape.color = take<std::array<float, 4>>(in);
        shapes.push_back(std::move(shape));
    }
}

static void take_link(StreamReader& in, UrdfLink& link) {
    for (std::string* text : {&link.name, &link.joint_name, &link.organ, &link.organ_name, &link.organ_material})
        *text = take_text(in);
    link.parent = take<int32_t>(in);
    const int32_t joint = take<int32_t>(in);
    in.good = in.good && joint >= 0 && joint <= int32_t(UrdfJoint::FLOATING);
    link.joint = UrdfJoint(in.good ? joint : 0);
    link.frame = take_frame(in);
    link.axis = take_vec(in);
    for (double* value : {&link.lower, &link.upper, &link.effort, &link.speed, &link.mass, &link.section_mass,
                          &link.stretching, &link.twisting, &link.bending_x, &link.bending_y, &link.taper})
        *value = take<double>(in);
    link.has_inertia = take<uint8_t>(in) != 0;
    link.centre = take_frame(in);
    for (int axis = 0; axis < 3; ++axis) link.inertia.col(axis) = take_vec(in);
    take_shapes(in, link.visuals);
    take_shapes(in, link.collisions);
}

void take_tree(StreamReader& in, UrdfTree& tree) {
    tree.name = take_text(in);
    const uint32_t links = take_count(in, MOST_LINKS);
    for (uint32_t i = 0; in.good && i < links; ++i) {
        tree.links.emplace_back();
        take_link(in, tree.links.back());
    }
    const uint32_t meshes = take_count(in, MOST_MESHES);
    for (uint32_t i = 0; in.good && i < meshes; ++i) {
        tree.meshes.emplace_back();
        tree.meshes.back().name = take_text(in);
        take_array(in, tree.meshes.back().positions);
        take_array(in, tree.meshes.back().triangles);
    }
}

}  // namespace frond
