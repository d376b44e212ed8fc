// Chain -> URDF: a link with a cylinder for each capsule, from its parent's end to its own along the link's z axis. The
// cylinder has the section's area; <frond> gives the stiffness, and the mass that the capsule has in the plant, whose
// organs weigh what their cage does.
#include "io/write_urdf.hpp"

#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"

namespace frond {

namespace {

struct Frame {
    Vec3 origin = Vec3::Zero();
    Quat turn = Quat::Identity();
};

// Replaces characters that XML does not allow in an attribute, and >.
std::string escaped(const std::string& text) {
    std::string out;
    for (char letter : text) {
        if (letter == '<' || letter == '&' || letter == '"' || letter == '>' || uint8_t(letter) < 32)
            out += '_';
        else
            out += letter;
    }
    return out;
}

std::string numbers(const Vec3& v) {
    return text_of("%.9g %.9g %.9g", v.x(), v.y(), v.z());
}

// Returns rotations about the fixed axes x, y, z, as URDF defines them.
std::string roll_pitch_yaw(const Quat& q) {
    const Mat3 R = q.toRotationMatrix();
    const double pitch = frond::atan2(-R(2, 0), frond::hypot(R(0, 0), R(1, 0)));
    const bool is_upright = frond::hypot(R(0, 0), R(1, 0)) < 1e-9;
    const double roll = is_upright ? frond::atan2(-R(1, 2), R(1, 1)) : frond::atan2(R(2, 1), R(2, 2));
    const double yaw = is_upright ? 0 : frond::atan2(R(1, 0), R(0, 0));
    return numbers({roll, pitch, yaw});
}

// Returns what each organ weighs in the plant over the mass of its sections [-]: what is drawn of it does, or its
// sections if that is nothing, and all together what the plant does.
std::vector<double> mass_factors(const Model& model) {
    std::vector<double> weights = model.organ_mass, of_sections(weights.size(), 0.0);
    for (size_t i = 0; i < model.sections.size(); i++)
        if (model.chain.nodes[i].parent >= 0)
            of_sections[size_t(std::max(model.chain.nodes[i].organ, 0))] +=
                model.sections[i].mass() * model.sections[i].length;
    double sum = 0;
    for (size_t i = 0; i < weights.size(); i++) {
        if (!(weights[i] > 0) || !(of_sections[i] > 0)) weights[i] = of_sections[i];
        sum += weights[i];
    }
    std::vector<double> factors(weights.size(), 1.0);
    for (size_t i = 0; i < factors.size(); i++)
        if (of_sections[i] > 0) factors[i] = weights[i] / of_sections[i] * model.mass() / sum;
    return factors;
}

std::string link_text(const Model& model, size_t node, const std::string& name, double mass_factor) {
    const Section& section = model.sections[node];
    const Organ& organ = model.organs[size_t(std::max(model.chain.nodes[node].organ, 0))];
    const double length = section.length, radius = std::sqrt(section.area / PI);
    const double mass = mass_factor * section.mass() * length;
    const std::string half = numbers({0, 0, 0.5 * length});
    const std::string centre = numbers({0, 0, section.mass_at_end() * length});
    const std::string geometry =
        text_of("      <origin xyz=\"%s\"/>\n      <geometry><cylinder radius=\"%.9g\" length=\"%.9g\"/></geometry>\n",
                half.c_str(), radius, length);
    const double around = mass * radius * radius / 2;
    const double across = around / 2 + mass * length * length * section.mass_spread();
    std::string text = "  <link name=\"" + name + "\">\n";
    text += "    <visual>\n" + geometry + "      <material name=\"" + escaped(organ.kind) + "\"/>\n    </visual>\n";
    text += "    <collision>\n" + geometry + "    </collision>\n";
    text += text_of(
        "    <inertial>\n      <origin xyz=\"%s\"/>\n      <mass value=\"%.9g\"/>\n      <inertia ixx=\"%.9g\" "
        "ixy=\"0\" ixz=\"0\" iyy=\"%.9g\" iyz=\"0\" izz=\"%.9g\"/>\n    </inertial>\n",
        centre.c_str(), mass, across, across, around);
    text += text_of(
        "    <frond organ=\"%s\" material=\"%s\" name=\"%s\" mass=\"%.9g\" stretching=\"%.9g\" bending=\"%.9g %.9g\" "
        "twisting=\"%.9g\" taper=\"%.9g\"/>\n",
        organ.kind.c_str(), preset_of(organ).c_str(), escaped(organ.name).c_str(),
        mass_factor * section.density * section.area, section.young * section.area,
        section.young * section.inertia_thin, section.young * section.inertia_wide, section.shear * section.torsion,
        section.taper);
    return text + "  </link>\n";
}

std::string joint_text(const std::string& parent, const std::string& child, const Frame& frame) {
    return "  <joint name=\"" + child + "_joint\" type=\"fixed\">\n    <parent link=\"" + parent +
           "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"" + numbers(frame.origin) + "\" rpy=\"" +
           roll_pitch_yaw(frame.turn) + "\"/>\n  </joint>\n";
}

// Returns the frame's rotation: z along the capsule, x where it is thinnest.
Quat turn_of(const Section& section) {
    Mat3 axes;
    axes.col(2) = section.axis;
    axes.col(0) = section.thin;
    axes.col(1) = section.axis.cross(section.thin);
    return Quat(axes).normalized();
}

}  // namespace

std::string urdf_of(const Model& model, const std::string& name) {
    const Quat upright = turn_between(Vec3::UnitY(), Vec3::UnitZ());
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(name) + "\">\n  <link name=\"ground\"/>\n";
    const std::vector<double> factors = mass_factors(model);
    std::vector<std::string> link(nodes.size(), "ground");
    std::vector<Frame> frames(nodes.size());  // frame of the link that ends in a node; at a root, the ground's
    for (size_t i = 0; i < nodes.size(); ++i) {
        const int parent = nodes[i].parent;
        if (parent < 0) continue;
        link[i] = "piece_" + std::to_string(i);
        frames[i] = {upright * nodes[size_t(parent)].position, (upright * turn_of(model.sections[i])).normalized()};
        const Frame& above = frames[size_t(parent)];
        const Quat back = above.turn.conjugate();
        text += link_text(model, i, link[i], factors[size_t(std::max(nodes[i].organ, 0))]);
        text += joint_text(link[size_t(parent)], link[i],
                           {back * (frames[i].origin - above.origin), back * frames[i].turn});
    }
    return text + "</robot>\n";
}

}  // namespace frond
