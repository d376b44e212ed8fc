// Reads URDF through urdfdom. In: checked text. Out: a tree of links, with the meshes that it names.
#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "importer/importer.hpp"
#include "importer/urdf.hpp"

namespace frond {

namespace {

// Keeps the first error that urdfdom reports.
struct Complaint : console_bridge::OutputHandler {
    std::string text;
    void log(const std::string& said, console_bridge::LogLevel level, const char*, int) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text.empty()) text = said;
    }
};

struct Reader {
    const MeshFile& file;
    UrdfText text;
    UrdfTree tree = {};
    std::map<std::string, int> mesh_of_path = {};
};

Vec3 vec_of(const urdf::Vector3& v) {
    return {v.x, v.y, v.z};
}

UrdfFrame frame_of(const urdf::Pose& pose) {
    const Quat turn(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
    return {vec_of(pose.position), turn.normalized()};
}

urdf::ModelInterfaceSharedPtr parse(const std::string& xml) {
    Complaint complaint;
    console_bridge::useOutputHandler(&complaint);
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(xml);
    console_bridge::restorePreviousOutputHandler();
    if (!model || !model->getRoot())
        fail(FROND_RESULT_FILE_FORMAT, "urdfdom does not take it: %.300s",
             complaint.text.empty() ? "it gives no cause" : complaint.text.c_str());
    return model;
}

// ---- shapes ----

// Reads the triangles of a mesh file as they are. A file that is named twice is read once. Returns the mesh's index.
int take_mesh(Reader& reader, const std::string& reference) {
    const std::string path = find_mesh(reader.file.folder, reference);
    const auto [known, is_new] = reader.mesh_of_path.emplace(path, int(reader.tree.meshes.size()));
    if (!is_new) return known->second;
    Surface surface;
    try {
        MeshFile mesh = open_file(path);
        if (mesh.format == FileFormat::URDF) fail(FROND_RESULT_FILE_FORMAT, "a mesh is not a URDF file");
        mesh.ignores_up = true;
        check_file(mesh);
        surface = mesh.format == FileFormat::PLY ? read_ply(mesh) : read_scene(mesh);
    } catch (const Error& error) {
        fail(error.code, "the mesh %.256s: %s", reference.c_str(), error.what());
    }
    reader.tree.meshes.push_back({reference, std::move(surface.positions), std::move(surface.triangles)});
    return known->second;
}

void take_geometry(Reader& reader, const urdf::Geometry& geometry, bool is_capsule, bool with_mesh, UrdfShape& shape) {
    switch (geometry.type) {
        case urdf::Geometry::SPHERE:
            shape.kind = UrdfKind::SPHERE;
            shape.size = Vec3::Constant(static_cast<const urdf::Sphere&>(geometry).radius);
            break;
        case urdf::Geometry::BOX:
            shape.kind = UrdfKind::BOX;
            shape.size = vec_of(static_cast<const urdf::Box&>(geometry).dim);
            break;
        case urdf::Geometry::CYLINDER: {
            const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
            shape.kind = is_capsule ? UrdfKind::CAPSULE : UrdfKind::CYLINDER;
            shape.size = Vec3(cylinder.radius, cylinder.length, 0);
            break;
        }
        case urdf::Geometry::MESH: {
            const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
            shape.kind = UrdfKind::MESH;
            shape.size = vec_of(mesh.scale);
            if (with_mesh) shape.mesh = take_mesh(reader, mesh.filename);
            break;
        }
    }
}

float linear_channel(float value) {
    return value >= 0 ? linear_of(std::min(value, 1.0f)) : 0;
}

void take_material(const urdf::Visual& visual, UrdfShape& shape) {
    shape.material = visual.material_name;
    if (!visual.material) return;
    const urdf::Color& color = visual.material->color;
    shape.has_color = color.r > 0 || color.g > 0 || color.b > 0 || color.a > 0;
    const float alpha = color.a > 0 ? std::min(color.a, 1.0f) : 0;
    shape.color = {linear_channel(color.r), linear_channel(color.g), linear_channel(color.b), alpha};
}

// Fails if urdfdom left out elements, as it does if it cannot read one of their numbers.
void check_count(const std::string& link, const char* what, size_t got, size_t wanted, int line) {
    if (got != wanted)
        fail(FROND_RESULT_FILE_FORMAT,
             "line %d: %zu of the <%s> elements of link \"%.64s\" cannot be read; look for missing geometry, nan, inf "
             "and "
             "decimal commas",
             line, wanted - std::min(got, wanted), what, link.c_str());
}

void take_shapes(Reader& reader, const urdf::Link& from, const UrdfNotes& notes, UrdfUse use, UrdfLink& link) {
    check_count(from.name, "visual", from.visual_array.size(), notes.visual_capsules.size(), notes.line);
    check_count(from.name, "collision", from.collision_array.size(), notes.collision_capsules.size(), notes.line);
    const bool is_seen = use == UrdfUse::SEEN && !from.visual_array.empty();
    for (size_t i = 0; i < from.visual_array.size(); ++i) {
        UrdfShape shape;
        shape.frame = frame_of(from.visual_array[i]->origin);
        take_geometry(reader, *from.visual_array[i]->geometry, notes.visual_capsules[i], is_seen, shape);
        take_material(*from.visual_array[i], shape);
        link.visuals.push_back(shape);
    }
    for (size_t i = 0; i < from.collision_array.size(); ++i) {
        UrdfShape shape;
        shape.frame = frame_of(from.collision_array[i]->origin);
        take_geometry(reader, *from.collision_array[i]->geometry, notes.collision_capsules[i], !is_seen, shape);
        link.collisions.push_back(shape);
    }
}

// ---- links ----

void take_inertia(const urdf::Link& from, const UrdfNotes& notes, UrdfLink& link) {
    check_count(from.name, "inertial", from.inertial ? 1 : 0, notes.has_inertial ? 1 : 0, notes.line);
    if (!from.inertial) return;
    const urdf::Inertial& inertial = *from.inertial;
    link.has_inertia = true;
    link.mass = inertial.mass;
    link.centre = frame_of(inertial.origin);
    link.inertia << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy, inertial.iyz, inertial.ixz,
        inertial.iyz, inertial.izz;
}

UrdfJoint kind_of(int type) {
    switch (type) {
        case urdf::Joint::REVOLUTE:
            return UrdfJoint::REVOLUTE;
        case urdf::Joint::CONTINUOUS:
            return UrdfJoint::CONTINUOUS;
        case urdf::Joint::PRISMATIC:
            return UrdfJoint::PRISMATIC;
        case urdf::Joint::FLOATING:
            return UrdfJoint::FLOATING;
        default:
            return UrdfJoint::FIXED;
    }
}

void take_joint(const urdf::Joint& joint, UrdfLink& link) {
    link.joint_name = joint.name;
    link.joint = kind_of(joint.type);
    link.frame = frame_of(joint.parent_to_joint_origin_transform);
    const bool has_axis = link.joint != UrdfJoint::FIXED && link.joint != UrdfJoint::FLOATING;
    if (has_axis) link.axis = vec_of(joint.axis);
    if (has_axis && !(link.axis.norm() > 1e-9 && link.axis.norm() < 1e9))
        fail(FROND_RESULT_FILE_FORMAT, "joint \"%.64s\" has no axis: it is of length %g", joint.name.c_str(),
             link.axis.norm());
    link.axis.normalize();
    if (!joint.limits) return;
    link.lower = joint.limits->lower;
    link.upper = joint.limits->upper;
    link.effort = joint.limits->effort;
    link.speed = joint.limits->velocity;
}

void take_links(Reader& reader, const urdf::ModelInterface& model, UrdfUse use) {
    std::vector<std::pair<urdf::LinkConstSharedPtr, int>> open = {{model.getRoot(), -1}};
    for (size_t next = 0; next < open.size(); ++next) {
        const auto [from, parent] = open[next];
        const auto notes = reader.text.links.find(from->name);
        if (notes == reader.text.links.end())
            fail(FROND_RESULT_FILE_FORMAT, "urdfdom reads a link \"%.64s\" that is not in the text",
                 from->name.c_str());
        UrdfLink link = notes->second.of_frond;
        link.name = from->name;
        link.parent = parent;
        if (from->parent_joint) take_joint(*from->parent_joint, link);
        take_inertia(*from, notes->second, link);
        take_shapes(reader, *from, notes->second, use, link);
        reader.tree.links.push_back(std::move(link));
        for (const urdf::LinkSharedPtr& child : from->child_links) open.push_back({child, int(next)});
        if (open.size() > reader.text.links.size()) break;
    }
    if (reader.tree.links.size() != reader.text.links.size())
        fail(FROND_RESULT_FILE_FORMAT, "urdfdom reads %zu of its %zu links", reader.tree.links.size(),
             reader.text.links.size());
}

}  // namespace

UrdfTree read_urdf(const MeshFile& file, UrdfUse use) {
    Reader reader = {file, check_urdf(file)};
    const urdf::ModelInterfaceSharedPtr model = parse(reader.text.xml);
    reader.tree.name = model->getName();
    take_links(reader, *model, use);
    const std::string wrong = what_is_wrong_with(reader.tree);
    if (!wrong.empty()) fail(FROND_RESULT_FILE_FORMAT, "%s", wrong.c_str());
    return std::move(reader.tree);
}

}  // namespace frond
