// In: organs as found, and corrections by their names. Out: organs as a person wants them.
#include "skeleton/organ_correct.hpp"

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "skeleton/organ_clues.hpp"

namespace frond {

namespace {

size_t find_organ(const std::vector<Organ>& organs, const std::string& name, const char* what) {
    const auto at = std::find_if(organs.begin(), organs.end(), [&](const Organ& one) { return one.name == name; });
    if (at == organs.end())
        fail(FROND_RESULT_BAD_ARGUMENT, "%s names the organ \"%s\"; this model has: %s", what, name.c_str(),
             list_organs(organs).c_str());
    return size_t(at - organs.begin());
}

// Gives an organ a kind with its preset, "blade" or "grass_blade"; one that it has already changes nothing.
void take_kind(const std::string& wanted, Organ& organ) {
    const std::string kind = kind_of_preset(wanted);
    const Material* preset = material_preset(wanted);
    if (!preset)
        fail(FROND_RESULT_BAD_ARGUMENT, "the kind of organ \"%s\" is corrected to \"%s\"; use %s", organ.name.c_str(),
             wanted.c_str(), material_kinds().c_str());
    if (organ.kind != kind || wanted != kind) {
        organ.material = *preset;
        organ.young_given = organ.midrib_given = false;
    }
    organ.kind = kind;
    organ.why = "corrected";
    organ.certainty = 1;
}

void take_material(const OrganCorrection& correction, Organ& organ) {
    for (const auto& [number, value] : correction.material) {
        const auto field = MATERIAL_FIELDS[size_t(number)].field;
        organ.material.*field = value;
        organ.young_given |= field == &Material::young;
        organ.midrib_given |= field == &Material::midrib;
    }
    check_material(organ.material, organ.name);
}

// Removes the triangles of organs from the surface; vertices stay.
void remove_triangles(const std::vector<char>& is_out, Surface& surface) {
    std::vector<Triangle> kept;
    std::vector<Part> parts;
    for (Part part : surface.parts) {
        if (part.organ >= 0 && is_out[size_t(part.organ)]) continue;
        const auto from = surface.triangles.begin() + part.first_triangle;
        part.first_triangle = int(kept.size());
        kept.insert(kept.end(), from, from + part.triangle_count);
        parts.push_back(part);
    }
    if (kept.empty()) fail(FROND_RESULT_BAD_ARGUMENT, "all organs are left out; leave at least one of the plant's in");
    surface.triangles = std::move(kept);
    surface.parts = std::move(parts);
}

// Removes organs, and renumbers the others.
void remove_organs(const std::vector<char>& is_out, Surface& surface, std::vector<Organ>& organs) {
    std::vector<int> number(organs.size(), -1);
    std::vector<Organ> kept;
    for (size_t o = 0; o < organs.size(); o++) {
        if (is_out[o]) continue;
        number[o] = int(kept.size());
        kept.push_back(organs[o]);
    }
    for (Part& part : surface.parts)
        if (part.organ >= 0) part.organ = number[size_t(part.organ)];
    organs = std::move(kept);
}

// Which components hold triangles of which organs.
struct Meshes {
    std::vector<int> organ_of;                 // by triangle
    std::vector<std::vector<int>> components;  // by organ, sorted
    std::vector<int> organs_in;                // by component, number of organs
};

Meshes list_meshes(const Surface& surface, const Topology& topology, size_t organ_count) {
    Meshes meshes{std::vector<int>(surface.triangles.size(), -1), std::vector<std::vector<int>>(organ_count),
                  std::vector<int>(size_t(topology.component_count), 0)};
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count && part.organ >= 0; t++) {
            meshes.organ_of[size_t(t)] = part.organ;
            meshes.components[size_t(part.organ)].push_back(topology.triangle_component[size_t(t)]);
        }
    for (std::vector<int>& list : meshes.components) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        for (int component : list) meshes.organs_in[size_t(component)]++;
    }
    return meshes;
}

// Returns the joint by which a component hangs on others of which one is wanted, -1 if none leads there.
int find_joint_towards(const Topology& topology, int component, const std::vector<int>& wanted) {
    std::map<int, int> first = {{component, -1}};  // first joint of the way to each component
    std::vector<int> queue = {component};
    const auto end = [&](int triangle) { return topology.triangle_component[size_t(triangle)]; };
    for (size_t at = 0; at < queue.size(); at++)
        for (size_t j = 0; j < topology.joints.size(); j++) {
            const int a = end(topology.joints[j].triangle_a), b = end(topology.joints[j].triangle_b);
            if (a != queue[at] && b != queue[at]) continue;
            const int other = a == queue[at] ? b : a;
            if (!first.emplace(other, queue[at] == component ? int(j) : first.at(queue[at])).second) continue;
            if (std::binary_search(wanted.begin(), wanted.end(), other)) return first.at(other);
            queue.push_back(other);
        }
    return -1;
}

// Returns the joint between the corners of two organs that are nearest to each other; of large ones some are tried.
Joint nearest_joint(const Topology& topology, const std::vector<int>& own, const std::vector<int>& others) {
    constexpr size_t MOST = 2000;  // triangles tried of each
    Joint best = {};
    double least = INFINITY;
    for (size_t i = 0; i < own.size(); i += 1 + own.size() / MOST)
        for (size_t k = 0; k < others.size(); k += 1 + others.size() / MOST)
            for (int p : topology.triangles[size_t(own[i])])
                for (int q : topology.triangles[size_t(others[k])]) {
                    const Vec3 &a = topology.points[size_t(p)], &b = topology.points[size_t(q)];
                    if (!((a - b).squaredNorm() < least)) continue;
                    least = (a - b).squaredNorm();
                    best = {own[i], others[k], a, b};
                }
    return best;
}

void hang_on(const Meshes& meshes, size_t organ, size_t parent, const std::vector<Organ>& organs, Topology& topology) {
    std::vector<int> others;
    for (size_t t = 0; t < meshes.organ_of.size(); t++)
        if (meshes.organ_of[t] == int(parent)) others.push_back(int(t));
    for (int component : meshes.components[organ]) {
        if (meshes.organs_in[size_t(component)] > 1)
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "the parent of \"%s\" is corrected to \"%s\", but it is one mesh with another organ; only organs that "
                 "are meshes of their own can be hung elsewhere",
                 organs[organ].name.c_str(), organs[parent].name.c_str());
        const int joint = find_joint_towards(topology, component, meshes.components[parent]);
        if (joint >= 0) topology.joints.erase(topology.joints.begin() + joint);
        std::vector<int> own;
        for (size_t t = 0; t < meshes.organ_of.size(); t++)
            if (topology.triangle_component[t] == component) own.push_back(int(t));
        topology.joints.push_back(nearest_joint(topology, own, others));
    }
}

void correct_parents(const std::vector<OrganCorrection>& corrections, const Surface& surface, Topology& topology,
                     const std::vector<Organ>& organs, const std::vector<int>& rooted) {
    std::map<size_t, size_t> wanted;
    for (const OrganCorrection& one : corrections) {
        if (one.parent.empty() || one.leave_out) continue;
        const size_t organ = find_organ(organs, one.organ, "a correction"),
                     parent = find_organ(organs, one.parent, "a correction of a parent");
        if (organ == parent)
            fail(FROND_RESULT_BAD_ARGUMENT, "the parent of \"%s\" is corrected to itself; name another organ",
                 one.organ.c_str());
        wanted[organ] = parent;
    }
    if (wanted.empty()) return;
    const std::vector<int> parents = find_parents(make_chain(surface, topology, organs, {0, 0, rooted}), organs.size());
    const Meshes meshes = list_meshes(surface, topology, organs.size());
    for (const auto& [organ, parent] : wanted)
        if (parents[organ] != int(parent)) hang_on(meshes, organ, parent, organs, topology);
}

}  // namespace

std::vector<int> find_parents(const Chain& chain, size_t organ_count) {
    std::vector<int> parents(organ_count, -1);
    std::vector<double> nearest(organ_count, INFINITY);
    for (const ChainNode& node : chain.nodes) {
        if (node.organ < 0 || node.distance >= nearest[size_t(node.organ)]) continue;
        // A root has no capsule, so that its organ says nothing.
        const bool on_root = node.parent < 0 || chain.nodes[size_t(node.parent)].parent < 0;
        const int below = on_root ? node.organ : chain.nodes[size_t(node.parent)].organ;
        if (below == node.organ && !on_root) continue;
        nearest[size_t(node.organ)] = node.distance;
        parents[size_t(node.organ)] = on_root ? -1 : below;
    }
    return parents;
}

std::vector<int> correct_organs(const std::vector<OrganCorrection>& corrections, Surface& surface, Topology& topology,
                                std::vector<Organ>& organs) {
    if (corrections.empty()) return {};
    std::vector<char> is_out(organs.size(), 0);
    for (const OrganCorrection& one : corrections) {
        const size_t o = find_organ(organs, one.organ, "a correction");
        if (!one.kind.empty()) take_kind(one.kind, organs[o]);
        take_material(one, organs[o]);
        is_out[o] = one.leave_out;
    }
    if (std::find(is_out.begin(), is_out.end(), 1) != is_out.end()) {
        remove_triangles(is_out, surface);
        clean_surface(surface);
        topology = make_topology(surface);
        remove_organs(is_out, surface, organs);
    }
    std::vector<int> rooted;
    for (const OrganCorrection& one : corrections)
        if (one.is_root && !one.leave_out) rooted.push_back(int(find_organ(organs, one.organ, "a correction")));
    correct_parents(corrections, surface, topology, organs, rooted);
    return rooted;
}

static bool is_of(const frond_organ_material& wanted, const Organ& organ) {
    return organ.name == wanted.organ || organ.kind == wanted.organ;
}

void override_materials(std::vector<Organ>& organs, const frond_organ_material* overrides, int count) {
    if (count < 0 || (count > 0 && !overrides))
        fail(FROND_RESULT_BAD_ARGUMENT, "organ_count is %d but organs is %s; give an array of that many", count,
             overrides ? "an array" : "null");
    for (int i = 0; i < count; i++) {
        const frond_organ_material& wanted = overrides[i];
        if (!wanted.organ || !*wanted.organ)
            fail(FROND_RESULT_BAD_ARGUMENT, "organs[%d].organ is empty; give the name or the kind of an organ", i);
        check_material(wanted.material, wanted.organ);
        if (std::none_of(organs.begin(), organs.end(), [&](const Organ& organ) { return is_of(wanted, organ); }))
            fail(FROND_RESULT_BAD_ARGUMENT, "no organ has the name or kind \"%s\"; this model has: %s", wanted.organ,
                 list_organs(organs).c_str());
    }
    for (Organ& organ : organs) {
        const Material* wanted = nullptr;
        for (int i = 0; i < count; i++)
            if (is_of(overrides[i], organ)) wanted = &overrides[i].material;
        if (!wanted) continue;
        organ.young_given |= wanted->young != organ.material.young;
        organ.midrib_given |= wanted->midrib != organ.material.midrib;
        organ.material = *wanted;
    }
}

}  // namespace frond
