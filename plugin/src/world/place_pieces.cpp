// In: ends of a plant's capsules, frames of its plates. Out: a Bullet compound in these places.
#include "world/plant_shape.hpp"

#include <algorithm>

#include "batch/flat.hpp"
#include "core/decompose.hpp"
#include "core/lane_vectors.hpp"
#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr double BACK = -0.99;  // cosine from which on the shortest rotation is ill-conditioned

// The shortest rotation from y: 1 + [k] + [k]^2 / (1 + cos), k = y x axis.
btTransform capsule_frame(const Vec3& begin, const Vec3& end) {
    const Vec3 chord = end - begin, axis = chord.normalized();
    const btVector3 middle = to_bullet(0.5 * (begin + end));
    if (axis == Vec3::Zero()) return btTransform(btQuaternion::getIdentity(), middle);
    if (!(axis.y() > BACK)) return btTransform(to_bullet(turn_between(Vec3::UnitY(), axis)), middle);
    const double over = 1 / (1 + axis.y()), across = -axis.x() * axis.z() * over;
    const btScalar x = btScalar(axis.x()), y = btScalar(axis.y()), z = btScalar(axis.z());
    return btTransform(btMatrix3x3(btScalar(1 - axis.x() * axis.x() * over), x, btScalar(across),  //
                                   -x, y, -z,                                                      //
                                   btScalar(across), z, btScalar(1 - axis.z() * axis.z() * over)),
                       middle);
}

namespace {

// Several children in lanes: their frames, by rows, and half extents of their boxes.
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

// Four of Bullet's numbers.
using FourScalars = VectorOf<btScalar, 4>::Type;
// Loads three numbers per lane from at(lane), where a fourth is readable.
template <class S, class At>
FROND_INLINE Lanes3<S> take_in(const At& at) {
    if constexpr (LANES<S> == 4) {
        FourLanes from[4], turned[4];
        for (int lane = 0; lane < 4; lane++) {
            FourScalars four;
            std::memcpy(&four, at(lane), sizeof four);
            from[lane] = convert_lanes<FourLanes>(four);
        }
        turn_over(from[0], from[1], from[2], from[3], turned);
        return {turned[0], turned[1], turned[2]};
    } else {
        return {gather<S>([&](int lane) { return double(at(lane)[0]); }),
                gather<S>([&](int lane) { return double(at(lane)[1]); }),
                gather<S>([&](int lane) { return double(at(lane)[2]); })};
    }
}

// Stores three numbers per lane in to(lane).
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
        const FourScalars four = convert_lanes<FourScalars>(turned[lane]);
        std::memcpy(to(lane).m_floats, &four, sizeof four);
    }
}

// Bounding boxes of children in lanes.
template <class S>
struct Boxes {
    Lanes3<S> lower, upper;
};
template <class S>
FROND_INLINE Lanes3<S> least(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {select(b.x < a.x, b.x, a.x), select(b.y < a.y, b.y, a.y), select(b.z < a.z, b.z, a.z)};
}
template <class S>
FROND_INLINE S larger(const S& a, const S& b) {
    return select(a < b, b, a);
}
template <class S>
FROND_INLINE btVector3 corner_of(const Lanes3<S>& v, int lane) {
    return btVector3(btScalar(v.x[lane]), btScalar(v.y[lane]), btScalar(v.z[lane]));
}

// Several children of one plant, from the first one on; the last one is repeated as padding.
template <class S>
struct ChildrenOfOne {
    static constexpr size_t MANY = size_t(LANES<S>);
    PlantShape& shape;
    const Hull& hull;
    const PiecesNow& now;

    FROND_INLINE int count_from(size_t first, size_t end) const { return int(std::min(MANY, end - first)); }
    FROND_INLINE PlantShape& shape_of(int) const { return shape; }
    FROND_INLINE static size_t child_of(size_t first, int lane) { return first + size_t(lane); }
    FROND_INLINE static S number(const std::vector<double>& of, size_t first) { return load<S>(&of[first]); }
    template <class Of>
    FROND_INLINE static Lanes3<S> three(const Of& of) {
        return {gather<S>([&](int lane) { return of(lane)[0]; }), gather<S>([&](int lane) { return of(lane)[1]; }),
                gather<S>([&](int lane) { return of(lane)[2]; })};
    }
    // Returns an end of capsule(lane).
    template <class Capsule>
    FROND_INLINE Lanes3<S> place(const Capsule& capsule, size_t end) const {
        return three([&](int lane) -> const Vec3& { return now.places[now.ends[capsule(lane)][end]]; });
    }
    FROND_INLINE size_t plate(size_t first, int lane) const {
        return std::min(first + size_t(lane), hull.plates.size() - 1);
    }
    FROND_INLINE size_t capsule(size_t first, int lane) const {
        return std::min(first + size_t(lane), hull.capsules.size() - 1);
    }
    FROND_INLINE Lanes3<S> axis(size_t first, int which) const {
        return three([&](int lane) { return now.frames[plate(first, lane)].data() + 3 * which; });
    }
    FROND_INLINE void set_box(const Boxes<S>& all) const {
        btVector3 lower(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), upper = -lower;
        for (int lane = 0; lane < LANES<S>; lane++) {
            lower.setMin(corner_of(all.lower, lane));
            upper.setMax(corner_of(all.upper, lane));
        }
        shape.set_box(lower, upper);
    }
};

// One child of several plants, whose chains begin at lane `from`; the last plant is repeated as padding.
template <class S>
struct ChildOfSeveral {
    static constexpr size_t MANY = 1;
    PlantShape* const* shapes;
    int count;
    const Hull& hull;
    const std::vector<std::array<int, 2>>& ends;
    const ChainBatch& chains;
    int from;

    FROND_INLINE int count_from(size_t, size_t) const { return count; }
    FROND_INLINE PlantShape& shape_of(int lane) const { return *shapes[std::min(lane, count - 1)]; }
    FROND_INLINE static size_t child_of(size_t first, int) { return first; }
    FROND_INLINE static S number(const std::vector<double>& of, size_t first) { return constant<S>(of[first]); }
    FROND_INLINE S number(const NumbersInLines& of, size_t i) const {
        return load<S>(of.data() + size_t(chains.lanes) * i + from);
    }
    FROND_INLINE Lanes3<S> three(const NumbersInLines& of, size_t i) const {
        return {number(of, i), number(of, i + 1), number(of, i + 2)};
    }
    template <class Capsule>
    FROND_INLINE Lanes3<S> place(const Capsule& capsule, size_t end) const {
        return three(chains.x, 6 * size_t(ends[capsule(0)][end]));
    }
    FROND_INLINE static size_t plate(size_t first, int) { return first; }
    FROND_INLINE static size_t capsule(size_t first, int) { return first; }
    FROND_INLINE Lanes3<S> axis(size_t first, int which) const {
        return three(chains.frames, 9 * first + 3 * size_t(which));
    }
    FROND_INLINE void set_box(const Boxes<S>& all) const {
        for (int lane = 0; lane < count; lane++)
            shape_of(lane).set_box(corner_of(all.lower, lane), corner_of(all.upper, lane));
    }
};

// Makes a child's box in the tree wider than the child, more so on sides that the child has left, as it will move on
// there. It keeps what it contained before as far as that is near.
void make_room(PlantShape& shape, size_t child, const btVector3& from, const btVector3& to) {
    constexpr btScalar WIDER = btScalar(0.03), AHEAD = btScalar(0.08), NEAR = btScalar(0.1);  // [m]
    btScalar *lower = &shape.room[PlantShape::ROOM * child], *upper = lower + PlantShape::UPPER;
    const bool is_new = lower[0] > upper[0];
    for (int c = 0; c < 3; c++) {
        const btScalar below = from[c] - (from[c] < lower[c] && !is_new ? AHEAD : WIDER),
                       above = to[c] + (to[c] > upper[c] && !is_new ? AHEAD : WIDER);
        lower[c] = std::max(std::min(lower[c], below), from[c] - NEAR);
        upper[c] = std::min(std::max(upper[c], above), to[c] + NEAR);
    }
    const btDbvtVolume volume =
        btDbvtVolume::FromMM(btVector3(lower[0], lower[1], lower[2]), btVector3(upper[0], upper[1], upper[2]));
    btDbvtNode& node = *shape.getChildList()[child].m_node;
    node.volume = volume;
    for (btDbvtNode* over = node.parent; over && !over->volume.Contain(volume); over = over->parent)
        Merge(over->volume, volume, over->volume);
    shape.growths++;
}

template <class S, template <class> class Group>
struct PlaceChildren {
    const Group<S>& group;
    const Hull& hull;

    FROND_INLINE static void set_frame(Children<S>& many, int lane, const btMatrix3x3& frame) {
        for (int r = 0; r < 3; r++) {
            many.rows.r[r].x[lane] = double(frame[r][0]);
            many.rows.r[r].y[lane] = double(frame[r][1]);
            many.rows.r[r].z[lane] = double(frame[r][2]);
        }
    }
    FROND_INLINE static Lanes3<S> column(const Lanes33<S>& rows, S Lanes3<S>::*which) {
        return {rows.r[0].*which, rows.r[1].*which, rows.r[2].*which};
    }
    FROND_INLINE Children<S> capsules(size_t first) const {
        const auto capsule = [&](int lane) { return group.capsule(first, lane); };
        const Lanes3<S> begin = group.place(capsule, 0), end = group.place(capsule, 1);
        const Lanes3<S> chord = end - begin, axis = S(1.0 / sqrt(dot(chord, chord))) * chord;
        const S over = 1.0 / (1.0 + axis.y), across = -axis.x * axis.z * over;
        Children<S> many;
        many.rows = {{{1.0 - axis.x * axis.x * over, axis.x, across},
                      {-axis.x, axis.y, -axis.z},
                      {across, axis.z, 1.0 - axis.z * axis.z * over}}};
        many.origin = constant<S>(0.5) * (begin + end);
        const auto is_well = axis.y > BACK;
        if (any(is_well == 0))
            for (int lane = 0; lane < LANES<S>; lane++) {
                const auto at = [&](const Lanes3<S>& v) { return Vec3(v.x[lane], v.y[lane], v.z[lane]); };
                if (!is_well[lane]) set_frame(many, lane, capsule_frame(at(begin), at(end)).getBasis());
            }
        const S radius = group.number(hull.capsule_radii, first);
        many.half = group.number(hull.capsule_halves, first) * absolute(column(many.rows, &Lanes3<S>::y)) +
                    Lanes3<S>{radius, radius, radius};
        return many;
    }
    FROND_INLINE Children<S> plates(size_t first) const {
        const auto capsule = [&](int lane) { return size_t(hull.plate_capsule[group.plate(first, lane)]); };
        const Lanes3<S> axis = group.axis(first, 0), thin = group.axis(first, 1), wide = group.axis(first, 2);
        Children<S> many;
        many.rows = {{{wide.x, axis.x, thin.x}, {wide.y, axis.y, thin.y}, {wide.z, axis.z, thin.z}}};
        many.origin = constant<S>(0.5) * (group.place(capsule, 0) + group.place(capsule, 1));
        const auto is_lost = dot(axis, axis) == 0.0;
        if (any(is_lost))
            for (int lane = 0; lane < LANES<S>; lane++) {
                const int child = int(hull.capsules.size() + group.plate(first, lane));
                if (is_lost[lane]) set_frame(many, lane, group.shape_of(lane).getChildTransform(child).getBasis());
            }
        const S margin = group.number(hull.plate_margins, first);
        many.half = group.number(hull.plate_halves[0], first) * absolute(column(many.rows, &Lanes3<S>::x)) +
                    group.number(hull.plate_halves[1], first) * absolute(column(many.rows, &Lanes3<S>::y)) +
                    Lanes3<S>{margin, margin, margin};
        return many;
    }
    FROND_INLINE void keep_in_tree(const Boxes<S>& boxes, size_t first, int count) const {
        const auto room = [&](int lane) -> const btScalar* {
            return &group.shape_of(lane).room[PlantShape::ROOM * group.child_of(first, lane)];
        };
        const Lanes3<S> lower = take_in<S>(room),
                        upper = take_in<S>([&](int lane) -> const btScalar* { return room(lane) + PlantShape::UPPER; });
        const Lanes3<S> most = -least(boxes.lower - lower, upper - boxes.upper);
        const auto is_out = larger<S>(larger<S>(most.x, most.y), most.z) > 0.0;
        if (!any(is_out)) return;
        for (int lane = 0; lane < count; lane++)
            if (is_out[lane])
                make_room(group.shape_of(lane), group.child_of(first, lane), corner_of(boxes.lower, lane),
                          corner_of(boxes.upper, lane));
    }
    FROND_INLINE void put(const Children<S>& many, size_t first, int count, Boxes<S>& all) const {
        const auto frame = [&](int lane) -> btTransform& {
            return group.shape_of(lane).getChildList()[group.child_of(first, lane)].m_transform;
        };
        for (int r = 0; r < 3; r++)
            hand_out(many.rows.r[r], count, [&](int lane) -> btVector3& { return frame(lane).getBasis()[r]; });
        hand_out(many.origin, count, [&](int lane) -> btVector3& { return frame(lane).getOrigin(); });
        const Boxes<S> boxes = {many.origin - many.half, many.origin + many.half};
        all.lower = least(all.lower, boxes.lower);
        all.upper = -least(-all.upper, -boxes.upper);
        keep_in_tree(boxes, first, count);
    }
    FROND_INLINE void run() const {
        const S far = constant<S>(double(BT_LARGE_FLOAT));
        Boxes<S> all = {{far, far, far}, {-far, -far, -far}};
        const size_t capsule_count = hull.capsules.size(), plate_count = hull.plates.size();
        for (size_t i = 0; i < capsule_count; i += group.MANY)
            put(capsules(i), i, group.count_from(i, capsule_count), all);
        for (size_t i = 0; i < plate_count; i += group.MANY)
            put(plates(i), capsule_count + i, group.count_from(i, plate_count), all);
        group.set_box(all);
    }
};

struct PlaceOfOne {
    PlantShape& shape;
    const Hull& hull;
    const PiecesNow& now;
    template <class S>
    FROND_INLINE void run() const {
        const ChildrenOfOne<S> group = {shape, hull, now};
        PlaceChildren<S, ChildrenOfOne>{group, hull}.run();
    }
};
struct PlaceOfSeveral {
    PlantShape* const* shapes;
    int count;
    const Hull& hull;
    const std::vector<std::array<int, 2>>& ends;
    const ChainBatch& chains;
    template <class S>
    FROND_INLINE void run() const {
        for (int from = 0; from < count; from += LANES<S>) {
            const ChildOfSeveral<S> group = {shapes + from, std::min(count - from, LANES<S>), hull, ends, chains, from};
            PlaceChildren<S, ChildOfSeveral>{group, hull}.run();
        }
    }
};

// Refits the inner boxes, which otherwise only grow.
void fit_tree(PlantShape& shape) {
    constexpr int MOST_GROWTHS = 256;  // between two refits, so that these cost little a growth
    if (shape.growths < MOST_GROWTHS) return;
    for (btDbvtNode* node : shape.inner) Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
    shape.growths = 0;
}

}  // namespace

void place_pieces(PlantShape& shape, const Hull& hull, const PiecesNow& now) {
    run_in_lanes(PlaceOfOne{shape, hull, now});
    fit_tree(shape);
}

void place_pieces(PlantShape* const* shapes, int count, const Hull& hull, const std::vector<std::array<int, 2>>& ends,
                  const ChainBatch& chains) {
    run_in_lanes(PlaceOfSeveral{shapes, count, hull, ends, chains});
    for (int i = 0; i < count; i++) fit_tree(*shapes[i]);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
