// Draws plants by a host's btIDebugDraw in debugDrawWorld. Bullet itself draws the capsules, as it draws any shape;
// this adds the cages' edges (DBG_DrawWireframe) and the contacts' points, normals and impulses
// (DBG_DrawContactPoints).
#include <LinearMath/btIDebugDraw.h>

#include <set>

#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

static void draw_cage(PlantBody& body, btIDebugDraw& drawer) {
    const btVector3 green(btScalar(0.2), btScalar(0.6), btScalar(0.2));
    const Plant& plant = *look_at(body).plant;
    std::set<std::pair<int, int>> edges;
    for (const Tet& tet : plant.model->cage.tets)
        for (size_t a = 0; a < 4; a++)
            for (size_t b = a + 1; b < 4; b++) edges.insert(std::minmax(tet[a], tet[b]));
    for (const auto& [a, b] : edges)
        drawer.drawLine(to_bullet(node_place(plant, a)), to_bullet(node_place(plant, b)), green);
}

// Draws a contact, and its mean force over the substep at a centimetre per newton.
static void draw_contact(const Vec3& point, const Vec3& normal, double gap, const Vec3& impulse, double h,
                         btIDebugDraw& drawer) {
    const btVector3 yellow(1, 1, 0), red(1, 0, 0);
    drawer.drawContactPoint(to_bullet(point), to_bullet(normal), btScalar(gap), 1, yellow);
    if (h > 0 && !impulse.isZero(0)) drawer.drawLine(to_bullet(point), to_bullet(point + 0.01 / h * impulse), red);
}

void World::debugDraw(btIDebugDraw* drawer) {
    if (!drawer) return;
    const int mode = drawer->getDebugMode();
    if (mode & btIDebugDraw::DBG_DrawWireframe) {
        for (const std::unique_ptr<PlantBody>& body : bodies) draw_cage(*body, *drawer);
        compress_looked_at(*this);
    }
    if (!(mode & btIDebugDraw::DBG_DrawContactPoints)) return;
    for (const Contact& c : contacts) draw_contact(c.on_plant, c.normal, c.gap, c.impulse, substep_length, *drawer);
    for (const PlantContact& c : plant_contacts)
        draw_contact(c.point, c.normal, -c.depth, c.impulse, substep_length, *drawer);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
