// In: where a plant's capsules end and how its plates lie. Out: a compound of Bullet's that is there.
#include "world/plant_shape.hpp"

#include <algorithm>

#include "core/lanes.hpp"
#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr double BACK = -0.99;  // cosine from which on the shortest turn is not well conditioned

// The shortest turn from y: 1 + [k] + [k]^2 / (1 + cos), k = y x axis.
btTransform capsule_frame(const Vec3& begin, const Vec3& end) {
    const Vec3 chord = end - begin, axis = chord.normalized();
    const btVector3 middle = to_bullet(0.5 * (begin + end));
    if (axis == Vec3::Zero()) return btTransform(btQuaternion::getIdentity(), middle);
    if (!(axis.y() > BACK)) {
        const Quat turn = Quat::FromTwoVectors(Vec3::UnitY(), axis);
        return btTransform(btQuaternion(btScalar(turn.x()), btScalar(turn.y()), btScalar(turn.z()), btScalar(turn.w())),
                           middle);
    }
    const double over = 1 / (1 + axis.y()), across = -axis.x() * axis.z() * over;
    const btScalar x = btScalar(axis.x()), y = btScalar(axis.y()), z = btScalar(axis.z());
    return btTransform(btMatrix3x3(btScalar(1 - axis.x() * axis.x() * over), x, btScalar(across),  //
                                   -x, y, -z,                                                      //
                                   btScalar(across), z, btScalar(1 - axis.z() * axis.z() * over)),
                       middle);
}

namespace {

constexpr size_t SIDES = 6;

// Nodes with others below them, those first.
void list_inner(btDbvtNode* node, std::vector<btDbvtNode*>& out) {
    if (!node || node->isleaf()) return;
    list_inner(node->childs[0], out);
    list_inner(node->childs[1], out);
    out.push_back(node);
}

// Several children at once: their frames, by rows, and half of their boxes.
template <class S>
struct Children {
    Lanes33<S> rows;
    Lanes3<S> origin, half;
};

template <class S>
FROND_INLINE Lanes3<S> absolute(const Lanes3<S>& v) {
    const auto of = [](const S& a) { return select(a < 0.0, S(-a), a); };
    return {of(v.x), of(v.y), of(v.z)};
}

// Several of Bullet's numbers.
using TwoScalars = btScalar __attribute__((vector_size(2 * sizeof(btScalar))));
using FourScalars = btScalar __attribute__((vector_size(4 * sizeof(btScalar))));
template <class S>
FROND_INLINE S load_scalars(const btScalar* from) {
    std::conditional_t<LANES<S> == 4, FourScalars, TwoScalars> out;
    __builtin_memcpy(&out, from, sizeof out);
    return __builtin_convertvector(out, S);
}

// Three numbers of each lane to the places that `to` names.
template <class S, class To>
FROND_INLINE void hand_out(const Lanes3<S>& v, int count, const To& to) {
    for (int lane = 0; lane < count; lane++) {
        btVector3& at = to(lane);
        at.setValue(btScalar(v.x[lane]), btScalar(v.y[lane]), btScalar(v.z[lane]));
    }
}
template <class To>
FROND_INLINE void hand_out(const Lanes3<FourLanes>& v, int count, const To& to) {
    FourLanes turned[4];
    turn_over(v.x, v.y, v.z, FourLanes{}, turned);
    for (int lane = 0; lane < count; lane++) {
        const FourScalars four = __builtin_convertvector(turned[lane], FourScalars);
        __builtin_memcpy(to(lane).m_floats, &four, sizeof four);
    }
}

struct PlaceChildren {
    PlantShape& shape;
    const Hull& hull;
    const PiecesNow& now;
    btVector3 &lower, &upper;

    template <class S, class Of>
    FROND_INLINE static Lanes3<S> three(const Of& of) {
        return {gather<S>([&](int lane) { return of(lane)[0]; }), gather<S>([&](int lane) { return of(lane)[1]; }),
                gather<S>([&](int lane) { return of(lane)[2]; })};
    }
    template <class S>
    FROND_INLINE static void set_frame(Children<S>& many, int lane, const btMatrix3x3& frame) {
        for (int r = 0; r < 3; r++) {
            many.rows.r[r].x[lane] = double(frame[r][0]);
            many.rows.r[r].y[lane] = double(frame[r][1]);
            many.rows.r[r].z[lane] = double(frame[r][2]);
        }
    }
    template <class S>
    FROND_INLINE static Lanes3<S> column(const Lanes33<S>& rows, S Lanes3<S>::*which) {
        return {rows.r[0].*which, rows.r[1].*which, rows.r[2].*which};
    }

    template <class S>
    FROND_INLINE Children<S> capsules(size_t first) const {
        const auto end_of = [&](int lane, size_t which) -> const Vec3& {
            return now.places[now.ends[std::min(first + size_t(lane), hull.capsules.size() - 1)][which]];
        };
        const Lanes3<S> begin = three<S>([&](int lane) -> const Vec3& { return end_of(lane, 0); }),
                        end = three<S>([&](int lane) -> const Vec3& { return end_of(lane, 1); });
        const Lanes3<S> chord = end - begin, axis = S(1.0 / sqrt(dot(chord, chord))) * chord;
        const S over = 1.0 / (1.0 + axis.y), across = -axis.x * axis.z * over;
        Children<S> many;
        many.rows = {{{1.0 - axis.x * axis.x * over, axis.x, across},
                      {-axis.x, axis.y, -axis.z},
                      {across, axis.z, 1.0 - axis.z * axis.z * over}}};
        many.origin = constant<S>(0.5) * (begin + end);
        for (int lane = 0; lane < LANES<S>; lane++)
            if (!(axis.y[lane] > BACK))
                set_frame(many, lane, capsule_frame(end_of(lane, 0), end_of(lane, 1)).getBasis());
        const S radius = load<S>(&hull.capsule_radii[first]);
        many.half = load<S>(&hull.capsule_halves[first]) * absolute(column(many.rows, &Lanes3<S>::y)) +
                    Lanes3<S>{radius, radius, radius};
        return many;
    }
    template <class S>
    FROND_INLINE Children<S> plates(size_t first) const {
        const auto plate = [&](int lane) { return std::min(first + size_t(lane), hull.plates.size() - 1); };
        const auto end_of = [&](int lane, size_t which) -> const Vec3& {
            return now.places[now.ends[size_t(hull.plate_capsule[plate(lane)])][which]];
        };
        const auto axes = [&](int from) {
            return three<S>([&](int lane) { return now.frames[plate(lane)].data() + from; });
        };
        const Lanes3<S> axis = axes(0), thin = axes(3), wide = axes(6);
        Children<S> many;
        many.rows = {{{wide.x, axis.x, thin.x}, {wide.y, axis.y, thin.y}, {wide.z, axis.z, thin.z}}};
        many.origin = constant<S>(0.5) * (three<S>([&](int lane) -> const Vec3& { return end_of(lane, 0); }) +
                                          three<S>([&](int lane) -> const Vec3& { return end_of(lane, 1); }));
        const S length = dot(axis, axis);
        for (int lane = 0; lane < LANES<S>; lane++)
            if (length[lane] == 0)
                set_frame(many, lane, shape.getChildTransform(int(hull.capsules.size() + plate(lane))).getBasis());
        const S margin = load<S>(&hull.plate_margins[first]);
        many.half = load<S>(&hull.plate_halves[0][first]) * absolute(column(many.rows, &Lanes3<S>::x)) +
                    load<S>(&hull.plate_halves[1][first]) * absolute(column(many.rows, &Lanes3<S>::y)) +
                    Lanes3<S>{margin, margin, margin};
        return many;
    }

    // Boxes of children from the first one on.
    template <class S>
    struct Boxes {
        Lanes3<S> lower, upper;
    };
    template <class S>
    FROND_INLINE void keep_in_tree(const Boxes<S>& boxes, size_t first, int count) const {
        const size_t stride = shape.room.size() / SIDES;
        const auto room = [&](size_t side) -> Lanes3<S> {
            const btScalar* at = &shape.room[side * stride + first];
            return {load_scalars<S>(at), load_scalars<S>(at + stride), load_scalars<S>(at + 2 * stride)};
        };
        const Lanes3<S> most = -least(boxes.lower - room(0), room(SIDES / 2) - boxes.upper);
        const auto larger = [](const S& a, const S& b) { return select(a < b, b, a); };
        const auto is_out = larger(larger(most.x, most.y), most.z) > 0.0;
        if (!any(is_out)) return;
        for (int lane = 0; lane < count; lane++)
            if (is_out[lane])
                make_room(first + size_t(lane),
                          btVector3(btScalar(boxes.lower.x[lane]), btScalar(boxes.lower.y[lane]),
                                    btScalar(boxes.lower.z[lane])),
                          btVector3(btScalar(boxes.upper.x[lane]), btScalar(boxes.upper.y[lane]),
                                    btScalar(boxes.upper.z[lane])));
    }
    void make_room(size_t child, const btVector3& from, const btVector3& to) const {
        constexpr btScalar WIDER = btScalar(0.03);  // [m]
        const btVector3 wider(WIDER, WIDER, WIDER);
        const btDbvtVolume volume = btDbvtVolume::FromMM(from - wider, to + wider);
        btDbvtNode& node = *shape.getChildList()[child].m_node;
        node.volume = volume;
        for (btDbvtNode* over = node.parent; over && !over->volume.Contain(volume); over = over->parent)
            Merge(over->volume, volume, over->volume);
        for (int c = 0; c < 3; c++) {
            shape.room[size_t(c) * shape.room.size() / SIDES + child] = volume.Mins()[c];
            shape.room[size_t(c + 3) * shape.room.size() / SIDES + child] = volume.Maxs()[c];
        }
        shape.growths++;
    }
    template <class S>
    FROND_INLINE void put(const Children<S>& many, size_t first, int count, Boxes<S>& all) const {
        btCompoundShapeChild* children = shape.getChildList() + first;
        for (int r = 0; r < 3; r++)
            hand_out(many.rows.r[r], count,
                     [&](int lane) -> btVector3& { return children[lane].m_transform.getBasis()[r]; });
        hand_out(many.origin, count, [&](int lane) -> btVector3& { return children[lane].m_transform.getOrigin(); });
        const Boxes<S> boxes = {many.origin - many.half, many.origin + many.half};
        all.lower = least(all.lower, boxes.lower);
        all.upper = -least(-all.upper, -boxes.upper);
        keep_in_tree(boxes, first, count);
    }
    template <class S>
    FROND_INLINE static Lanes3<S> least(const Lanes3<S>& a, const Lanes3<S>& b) {
        return {select(b.x < a.x, b.x, a.x), select(b.y < a.y, b.y, a.y), select(b.z < a.z, b.z, a.z)};
    }
    template <class S>
    FROND_INLINE void run() const {
        const S far = constant<S>(double(BT_LARGE_FLOAT));
        Boxes<S> all = {{far, far, far}, {-far, -far, -far}};
        const auto count_from = [](size_t first, size_t end) { return int(std::min(size_t(LANES<S>), end - first)); };
        for (size_t i = 0; i < hull.capsules.size(); i += size_t(LANES<S>))
            put(capsules<S>(i), i, count_from(i, hull.capsules.size()), all);
        for (size_t i = 0; i < hull.plates.size(); i += size_t(LANES<S>))
            put(plates<S>(i), hull.capsules.size() + i, count_from(i, hull.plates.size()), all);
        for (int lane = 0; lane < LANES<S>; lane++) {
            lower.setMin(
                btVector3(btScalar(all.lower.x[lane]), btScalar(all.lower.y[lane]), btScalar(all.lower.z[lane])));
            upper.setMax(
                btVector3(btScalar(all.upper.x[lane]), btScalar(all.upper.y[lane]), btScalar(all.upper.z[lane])));
        }
    }
};

}  // namespace

PlantShape::PlantShape(World& world, const Hull& hull) : world(world) {
    size_t child = 0;
    const auto add = [&](btCollisionShape& piece) {
        addChildShape(child < hull.modelled.size() ? hull.modelled[child] : btTransform::getIdentity(), &piece);
        child++;
    };
    for (const auto& capsule : hull.capsules) add(*capsule);
    for (const auto& plate : hull.plates) add(*plate);
    setMargin(btScalar(std::max(hull.wider_by_cage, hull.wider_by_sheath)));
    list_inner(getDynamicAabbTree()->m_root, inner);
    // None has any yet.
    const size_t stride = child + MOST_LANES;
    room.assign(SIDES * stride, btScalar(BT_LARGE_FLOAT));
    std::fill(room.begin() + std::ptrdiff_t(SIDES / 2 * stride), room.end(), btScalar(-BT_LARGE_FLOAT));
}

void PlantShape::getAabb(const btTransform& frame, btVector3& lower, btVector3& upper) const {
    if (!world.is_stepping) hold_gravity(world.gravity_ahead, *world.bullet);
    btCompoundShape::getAabb(frame, lower, upper);
}

void PlantShape::set_box(const btVector3& lower, const btVector3& upper) {
    m_localAabbMin = lower;
    m_localAabbMax = upper;
}

void place_pieces(PlantShape& shape, const Hull& hull, const PiecesNow& now) {
    btVector3 lower(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), upper = -lower;
    run_in_lanes(PlaceChildren{shape, hull, now, lower, upper});
    shape.set_box(lower, upper);
    constexpr int MOST_GROWTHS = 256;
    if (shape.growths < MOST_GROWTHS) return;
    for (btDbvtNode* node : shape.inner) Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
    shape.growths = 0;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
