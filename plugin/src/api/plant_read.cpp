// frond_plant_*: what can be read of a plant: its surface, capsules, contacts, forces and energy.
#include <algorithm>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/is_in.hpp"

using namespace frond;

static frond_effects effects_of(const PlantBody& body) {
    return body.plant->input.effects & body.world->effects;
}

// Returns the contacts of one plant, with normals and impulses as they act on it.
static std::vector<frond_contact> contacts_of(const PlantBody& body) {
    std::vector<frond_contact> out;
    const LastContacts* kept = body.rest.contacts.get();
    for (const Contact& c : kept ? kept->with_bodies : body.world->contacts)
        if (c.plant == &body && (!kept || is_in(*body.world->bullet, c.other)))
            out.push_back(
                {from_vec(c.on_plant), from_vec(c.normal), from_vec(c.impulse), c.gap, c.capsule, c.other, {}});
    for (const PlantContact& c : kept ? kept->with_plants : body.world->plant_contacts) {
        const size_t side = c.plants[0] == &body ? 0 : 1;
        if (c.plants[side] != &body) continue;
        const double sign = side == 0 ? 1 : -1;
        const Vec3 point = side == 0 ? c.point : Vec3(c.point + c.depth * c.normal);
        const PlantBody* other = c.plants[1 - side];
        out.push_back({from_vec(point), from_vec(sign * c.normal), from_vec(sign * c.impulse), -c.depth,
                       c.sides[side].piece, other, other->handle});
    }
    return out;
}

// Makes the surface as it is now. The last one goes to the previous frame, if that is requested.
static void make_surface(PlantBody& body) {
    Plant& p = *body.plant;
    const World& world = *body.world;
    const double back = body.rest.asleep ? 0 : surfaces_back(world);
    if (p.view.previous && (p.view.previous->substep != world.substep || p.view.previous->back != float(back))) {
        p.view.previous->positions = p.view.surface_positions;
        p.view.previous->substep = world.substep;
        p.view.previous->back = float(back);
    }
    const auto update = [&](frond_effects effects) {
        update_surface(*look_at(body).plant, effects, back);
        p.view.surface_made = uint32_t(world.substep);
    };
    if (p.view.surface_positions.empty()) update(FROND_EFFECT_ALL);
    if ((p.view.surface_stale || p.view.surface_back != float(back)) && effects_of(body) & FROND_EFFECT_SURFACE)
        update(effects_of(body));
}

extern "C" {

frond_result frond_plant_get_previous_positions(frond_plant plant, const float** out) {
    return give(out, [&] {
        PlantBody& body = get(plant);
        Plant& p = *body.plant;
        if (!p.view.previous) {
            p.view.previous = std::make_unique<PreviousSurface>();
            p.view.previous->substep = body.world->substep;
            p.view.previous->back = float(body.rest.asleep ? 0 : surfaces_back(*body.world));
        }
        make_surface(body);
        return (p.view.previous->positions.empty() ? p.view.surface_positions : p.view.previous->positions).data();
    });
}

frond_result frond_plant_get_surface(frond_plant plant, frond_surface_view* out) {
    return give(out, [&] {
        PlantBody& body = get(plant);
        Plant& p = *body.plant;
        make_surface(body);
        const Surface& surface = p.model->surface;
        frond_surface_view view = {};
        view.positions = p.view.surface_positions.data();
        view.normals = p.view.surface_normals.data();
        view.uvs = surface.uvs.empty() ? nullptr : surface.uvs.front().data();
        view.colors = surface.colors.empty() ? nullptr : surface.colors.front().data();
        view.indices = (p.state.fragments.empty() ? surface.triangles : p.state.parting->triangles).front().data();
        view.vertex_count = int(surface.positions.size());
        view.triangle_count = int(surface.triangles.size());
        return view;
    });
}

frond_result frond_plant_get_capsules(frond_plant plant, frond_capsule* out, int capsule_count) {
    return call([&] {
        check_pointer(out, "out");
        const PlantBody& body = look_at(get(plant));
        check_count(capsule_count, int(body.capsules().size()), "capsule_count");
        const Plant& p = *body.plant;
        for (size_t i = 0; i < body.capsules().size(); i++) {
            const auto [begin, end] = capsule_ends(p, i);
            out[i].begin = from_vec(p.to_world(begin));
            out[i].end = from_vec(p.to_world(end));
            out[i].radius = double(body.capsules()[i]->getRadius());
        }
    });
}

int frond_plant_get_capsule_count(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? int(body->capsules().size()) : 0;
}

frond_result frond_plant_get_strains(frond_plant plant, double* out, int capsule_count) {
    return call([&] {
        check_pointer(out, "out");
        const PlantBody& body = look_at(get(plant));
        check_count(capsule_count, int(body.capsules().size()), "capsule_count");
        const std::vector<double> strains = capsule_strains(*body.plant);
        std::copy(strains.begin(), strains.end(), out);
    });
}

int frond_plant_get_contact_count(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? int(contacts_of(*body).size()) : 0;
}

frond_result frond_plant_get_contacts(frond_plant plant, frond_contact* out, int contact_count) {
    return call([&] {
        const std::vector<frond_contact> contacts = contacts_of(get(plant));
        check_count(contact_count, int(contacts.size()), "contact_count");
        if (contact_count > 0) check_pointer(out, "out");
        std::copy(contacts.begin(), contacts.end(), out);
    });
}

frond_result frond_plant_get_air_force(frond_plant plant, frond_vec3* out) {
    return give(out, [&] { return from_vec(air_force(*look_at(get(plant)).plant)); });
}

frond_result frond_plant_get_momentum(frond_plant plant, frond_vec3* out) {
    return give(out, [&] {
        const Plant& p = *look_at(get(plant)).plant;
        const VecX& mass = node_mass_of(*p.system);
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < mass.size(); i++) sum += mass[i] * point(p.state.motion.v, i);
        return from_vec(p.rotation * sum);
    });
}

frond_result frond_plant_get_tip(frond_plant plant, frond_vec3* out) {
    return give(out, [&] {
        const PlantBody& body = look_at(get(plant));
        const Vec3 gravity = gravity_of(*body.world);
        const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity) : Vec3(Vec3::UnitY());
        const std::vector<Vec3> places = vertex_positions(*body.plant);
        const auto is_lower = [&](const Vec3& a, const Vec3& b) { return up.dot(a) < up.dot(b); };
        return from_vec(*std::max_element(places.begin(), places.end(), is_lower));
    });
}

frond_result frond_plant_get_energy(frond_plant plant, frond_energy* out) {
    return give(out, [&] {
        const PlantBody& body = look_at(get(plant));
        return energy_of(*body.plant, gravity_of(*body.world));
    });
}

}  // extern "C"
