// In: a plant's children and a body's convex pieces, at their places. Out: the children that Bullet is to look at.
//
// A child, a segment or rectangle with a radius, is far from a piece's bounding box, which turns with the piece, if a
// direction separates them by more than the distance at which Bullet makes contact points: one of the box's axes, of
// the child's or of their cross products (Gottschalk, Lin, Manocha 1996). Corners of the box that a hull leaves empty
// are found by one more direction, in which the hull's own extent counts.
#include "world/near_children.hpp"

#include <algorithm>
#include <typeinfo>

#include "world/plant_body.hpp"
#include "world/plant_shape.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Box of a convex shape, in the plant's frame.
struct Piece {
    const btConvexShape* shape;
    btTransform frame;       // its centre and axes
    btVector3 half, centre;  // in the shape's own frame [m]
};

// A capsule's or plate's core: a centre and one or two half lengths.
struct Core {
    btVector3 centre, half[2];
    int count;
    btScalar radius;
};

constexpr size_t MOST_PIECES = 32;  // of a body: each is tested against each child whose box it meets

// Lists the boxes of a shape's convex parts. Returns false if it has others, or too many.
bool list_pieces(const btCollisionShape& shape, const btTransform& frame, std::vector<Piece>& pieces, bool& has_hull) {
    if (shape.isCompound()) {
        const auto& compound = static_cast<const btCompoundShape&>(shape);
        for (int i = 0; i < compound.getNumChildShapes(); i++)
            if (!list_pieces(*compound.getChildShape(i), frame * compound.getChildTransform(i), pieces, has_hull))
                return false;
        return true;
    }
    if (!shape.isConvex() || shape.isInfinite() || pieces.size() == MOST_PIECES) return false;
    has_hull |= shape.getShapeType() == CONVEX_HULL_SHAPE_PROXYTYPE;
    btVector3 lower, upper;
    shape.getAabb(btTransform::getIdentity(), lower, upper);
    const btVector3 half = btScalar(0.5) * (upper - lower), centre = btScalar(0.5) * (upper + lower);
    pieces.push_back(
        {static_cast<const btConvexShape*>(&shape), btTransform(frame.getBasis(), frame * centre), half, centre});
    return true;
}

Core core_of(const PlantShape& shape, const Hull& hull, size_t child) {
    const btTransform& frame = shape.getChildTransform(int(child));
    const size_t capsules = hull.capsules.size();
    Core core;
    core.centre = frame.getOrigin();
    const btVector3 along = frame.getBasis().getColumn(1);
    if (child < capsules) {
        core.count = 1;
        core.half[0] = btScalar(hull.capsule_halves[child]) * along;
        core.radius = btScalar(hull.capsule_radii[child]);
        return core;
    }
    const size_t plate = child - capsules;
    core.count = 2;
    core.half[0] = btScalar(hull.plate_halves[1][plate]) * along;
    core.half[1] = btScalar(hull.plate_halves[0][plate]) * frame.getBasis().getColumn(0);
    core.radius = btScalar(hull.plate_margins[plate]);
    return core;
}

// Returns whether a direction, of any length, separates a core from a box around the origin by more than `distance`.
bool separates(const btVector3& way, const Core& core, const btVector3& half, btScalar distance) {
    btScalar reach = half.dot(way.absolute());
    for (int k = 0; k < core.count; k++) reach += btFabs(core.half[k].dot(way));
    const btScalar gap = btFabs(core.centre.dot(way)) - reach;
    return gap > 0 && gap * gap > distance * distance * way.length2();
}

// Returns the point of a core that is nearest to p.
btVector3 nearest_on(const Core& core, const btVector3& p) {
    btVector3 point = core.centre;
    for (int k = 0; k < core.count; k++) {
        const btScalar share = (p - core.centre).dot(core.half[k]) / std::max(core.half[k].length2(), SIMD_EPSILON);
        point += btClamped(share, btScalar(-1), btScalar(1)) * core.half[k];
    }
    return point;
}

// Returns whether a hull ends before a core, in the direction between the two: from the hull's middle, a box as much
// smaller than its own as that is thick, to the core. `core` is relative to the box.
bool is_beside_hull(const Core& core, const Piece& piece, btScalar distance) {
    if (piece.shape->getShapeType() != CONVEX_HULL_SHAPE_PROXYTYPE) return false;
    const btScalar thickness = std::min({piece.half.x(), piece.half.y(), piece.half.z()});
    const btVector3 inner = piece.half - btVector3(thickness, thickness, thickness);
    btVector3 middle(0, 0, 0), way;
    for (int round = 0; round < 2; round++) {
        const btVector3 near = nearest_on(core, middle);
        middle = near;
        middle.setMin(inner);
        middle.setMax(-inner);
        way = near - middle;
    }
    const btScalar length = way.length();
    if (!(length > SIMD_EPSILON)) return false;
    way /= length;
    const btVector3 farthest = piece.shape->localGetSupportingVertexWithoutMargin(way) - piece.centre;
    btScalar begin = core.centre.dot(way);
    for (int k = 0; k < core.count; k++) begin -= btFabs(core.half[k].dot(way));
    return begin - farthest.dot(way) - piece.shape->getMargin() > distance;
}

bool is_far(const Core& from, const Piece& piece, btScalar distance) {
    const btMatrix3x3& axes = piece.frame.getBasis();
    Core core = from;
    core.centre = (from.centre - piece.frame.getOrigin()) * axes;
    for (int k = 0; k < core.count; k++) core.half[k] = from.half[k] * axes;
    const btScalar least = distance + core.radius;
    const auto parts = [&](const btVector3& way) { return separates(way, core, piece.half, least); };
    const btVector3 unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const btVector3& axis : unit)
        if (parts(axis)) return true;
    for (int k = 0; k < core.count; k++) {
        if (parts(core.half[k])) return true;
        for (const btVector3& axis : unit)
            if (parts(axis.cross(core.half[k]))) return true;
    }
    if (core.count == 2 && parts(core.half[0].cross(core.half[1]))) return true;
    return is_beside_hull(core, piece, least);
}

// Distance from which on Bullet makes no contact points [m].
btScalar farthest_contact(const btCollisionDispatcher& dispatcher, const btCollisionShape& a,
                          const btCollisionShape& b) {
    const btScalar most = gContactBreakingThreshold;
    if (!(dispatcher.getDispatcherFlags() & btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD))
        return most;
    return std::min(a.getContactBreakingThreshold(most), b.getContactBreakingThreshold(most));
}

// Takes nodes without near children out of the tree.
struct TakeOut {
    const PlantShape& shape;
    const Hull& hull;
    const std::vector<Piece>& pieces;
    const btScalar distance;  // [m]
    const btDbvtVolume box;   // of all pieces, wider by that
    LackingShape& lacking;

    bool is_near(size_t child) const {
        const bool is_covered = child < hull.capsules.size() && hull.flats[child].half_width > 0;
        if (is_covered) return false;
        const Core core = core_of(shape, hull, child);
        const auto is_far_from = [&](const Piece& piece) { return is_far(core, piece, distance); };
        return !std::all_of(pieces.begin(), pieces.end(), is_far_from);
    }
    // Returns whether a near child is left under the node.
    bool visit(btDbvtNode& node) const {
        if (!Intersect(node.volume, box)) return false;
        const bool left = node.isleaf() ? is_near(size_t(node.dataAsInt))
                                        : int(visit(*node.childs[0])) + int(visit(*node.childs[1])) > 0;
        if (left) return true;
        lacking.nodes.emplace_back(&node, node.volume);
        const btVector3 nowhere(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
        node.volume = btDbvtVolume::FromMM(nowhere, nowhere);
        return false;
    }
};

}  // namespace

void leave_near_children(PlantBody& body, const btCollisionObject& other) {
    World& world = *body.world;
    LackingShape& lacking = world.lacking;
    put_back_children(lacking);
    const btDispatcher& any = *world.bullet->getDispatcher();
    if (typeid(any) != typeid(btCollisionDispatcher)) return;
    const auto& dispatcher = static_cast<const btCollisionDispatcher&>(any);
    const btCollisionShape& with = *other.getCollisionShape();
    const btTransform frame = body.getWorldTransform().inverseTimes(other.getWorldTransform());
    std::vector<Piece> pieces;
    bool has_hull = false;
    if (!list_pieces(with, frame, pieces, has_hull) || !has_hull) return;
    const auto& shape = static_cast<const PlantShape&>(*body.compound());
    const btScalar distance = farthest_contact(dispatcher, shape, with);
    btVector3 lower, upper;
    with.getAabb(frame, lower, upper);
    btDbvtVolume box = btDbvtVolume::FromMM(lower, upper);
    box.Expand(btVector3(distance, distance, distance));
    lacking.shape = &shape;
    const TakeOut take_out = {shape, *body.hull, pieces, distance, box, lacking};
    take_out.visit(*shape.getDynamicAabbTree()->m_root);
}

void put_back_children(LackingShape& lacking) {
    for (const auto& [node, volume] : lacking.nodes) node->volume = volume;
    lacking.nodes.clear();
    lacking.shape = nullptr;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
