// In: a snapshot, or its bytes. Out: the other. Layout: magic word, version, precision, length and checksum
// of what follows; then everything in the order below.
#include <cstring>

#include "core/error.hpp"
#include "world/snapshot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

static void visit(Archive& a, btVector3& v) {
    a.numbers<btScalar>(v, 3);
}

static void visit(Archive& a, btTransform& frame) {
    for (int row = 0; row < 3; row++) a(frame.getBasis()[row]);
    a(frame.getOrigin());
}

static void visit(Archive& a, Foreseen::Give& give) {
    a(give.to.link), a.one_of(give.to.kind, Foreseen::KIND_COUNT), a(give.work);
}

static void visit(Archive& a, Foreseen::Part& part) {
    a.one_of(part.kind, Foreseen::KIND_COUNT), a(part.impulse), a(part.work), a(part.gives);
}

static void visit_foreseen(Archive& a, Foreseen& foreseen) {
    a(foreseen.parts), a(foreseen.place), a(foreseen.most_friction);
}

static void visit(Archive& a, SavedContact& saved) {
    Contact& c = saved.contact;
    a(saved.plant), a(c.capsule), a(saved.other), a(c.along), a(c.across), a(c.gap), a(c.friction);
    a(c.on_plant), a(c.on_other), a(c.normal), a(c.impulse);
    visit_foreseen(a, c.foreseen);
}

static void visit_side(Archive& a, ContactSide& side) {
    a(side.body), a(side.organ), a(side.piece), a(side.node_count), a(side.nodes), a(side.weights);
}

static void visit_attachment(Archive& a, Attachment& attachment) {
    a(attachment.count), a(attachment.turns), a(attachment.node), a(attachment.weight), a(attachment.arm);
}

static void visit(Archive& a, SavedPlantContact& saved) {
    PlantContact& c = saved.contact;
    a(saved.plants);
    for (ContactSide& side : c.sides) visit_side(a, side);
    for (Attachment& attachment : c.attachments) visit_attachment(a, attachment);
    a(c.by_sheath), a(c.on_chain), a(c.by_strips), a(c.between), a(c.point), a(c.normal), a(c.depth), a(c.friction),
        a(c.missed), a(c.impulse);
}

static void visit_touches(Archive& a, SavedTouches& touches) {
    a(touches.with_bodies), a(touches.with_plants);
}

static void visit(Archive& a, SavedGrownIn& grown_in) {
    a(grown_in.capsule), a(grown_in.other), a(grown_in.depth);
}

static void visit(Archive& a, SavedFragment& fragment) {
    FragmentMotion& motion = fragment.motion;
    a(fragment.node), a(motion.turn), a(motion.shift), a(motion.centre), a(motion.velocity), a(motion.angular_velocity);
}

static void visit_blend_out(Archive& a, BlendOut& blend_out) {
    a(blend_out.offset), a(blend_out.rate), a(blend_out.time);
}

static void visit(Archive& a, Blend& blend) {
    for (BlendOut* part : {&blend.turns, &blend.surface, &blend.nodes}) visit_blend_out(a, *part);
}

static void visit(Archive& a, ModalState& modal) {
    a(modal.place), a(modal.speed), a(modal.rest), a(modal.damping), a(modal.since), a(modal.comes_to_rest),
        a(modal.fresh);
    visit_blend_out(a, modal.blend_out);
}

static void visit(Archive& a, Support& support) {
    a(support.chain_node), a(support.holds_place), a.one_of(support.held_turns, FROND_HELD_TURNS_COUNT);
    a(support.axis), a(support.place), a(support.turn);
}

static void visit_motion(Archive& a, Motion& motion) {
    History& history = motion.history;
    a(motion.x), a(motion.v), a(motion.pinned), a(motion.pin_target);
    a(history.valid), a(history.shaken), a.one_of(history.integrator, FROND_INTEGRATOR_COUNT), a(history.h),
        a(history.x_end), a(history.v_end);
    a(history.pinned), a(history.x_prev), a(history.v_prev), a(history.x_rate), a(history.v_rate);
}

static void visit_level(Archive& a, Level& level) {
    a.one_of(level.now, FROND_DETAIL_COUNT), a.one_of(level.own, FROND_MECHANICS_COUNT), a(level.every),
        a(level.pending), a(level.is_due), a(level.distance), a(level.disturbed);
}

static void visit(Archive& a, SavedPlant& plant) {
    a(plant.kind), a.one_of(plant.which, FROND_MECHANICS_COUNT);
    SavedInput& input = plant.input;
    SavedState& state = plant.state;
    visit_motion(a, state.motion);
    a(state.trend.v_end), a(state.trend.rate);
    a(plant.lead), a(plant.blend), a(plant.modal), a(plant.has_own_elements), a(plant.plastic), a(state.fibre_give);
    a(state.stretched);
    a(input.pinned), a(input.pin_target), a(input.anchor), a(plant.supports);
    a(input.pins_changed), a(input.pins_are_own), a(input.has_user_force), a(state.is_touched), a(state.is_entangled);
    a(plant.forces.on_nodes), a(plant.forces.on_chain), a(state.substeps), a(state.recovers_for), a(plant.grab_targets),
        a(plant.fragments), a(plant.parted_at);
    a(plant.new_for), a(plant.asleep), a(plant.still), a(plant.places), a(plant.air);
    visit_level(a, plant.level);
    a(plant.grown_in);
    visit_touches(a, plant.asleep_with);
}

static void visit(Archive& a, SavedRigid& rigid) {
    a(rigid.is_plane), a(rigid.is_fragment), a(rigid.frame), a(rigid.frame_before), a(rigid.velocity),
        a(rigid.angular_velocity);
    a(rigid.velocity_before), a(rigid.angular_velocity_before), a(rigid.force), a(rigid.torque), a(rigid.activation),
        a(rigid.still), a(rigid.has_left);
}

static void visit(Archive& a, SavedAhead& ahead) {
    a(ahead.body), a(ahead.force);
}

static void visit(Archive& a, SavedBond& bond) {
    a(bond.vertex), a(bond.body), a(bond.impulse), a(bond.length);
    visit_foreseen(a, bond.foreseen);
}

static void visit_all(Archive& a, Snapshot& s) {
    a(s.time), a(s.travelled), a(s.turn), a(s.substep), a(s.gravity_before), a(s.effects_before), a(s.is_held);
    a(s.plants), a(s.rigids), a(s.bonds), a(s.ahead), a(s.others_before);
    visit_touches(a, s.touches);
}

namespace {

constexpr char MAGIC[8] = {'F', 'R', 'O', 'N', 'D', 'S', 'N', 'P'};
constexpr uint32_t LAYOUT = 6;  // to be raised with every change above

struct Head {
    char magic[8];
    char version[16];  // Frond's: steps may change with it
    uint32_t layout, precision;
    uint64_t length, checksum;
};

Head head_of(const uint8_t* bytes, size_t count) {
    Head head = {};
    std::memcpy(head.magic, MAGIC, sizeof MAGIC);
    std::strncpy(head.version, FROND_VERSION_STRING, sizeof head.version - 1);
    head.layout = LAYOUT;
    head.precision = sizeof(btScalar);
    head.length = count;
    head.checksum = checksum_of(bytes, count);
    return head;
}

}  // namespace

std::vector<uint8_t> bytes_of(Snapshot& snapshot) {
    Archive archive;
    visit_all(archive, snapshot);
    const Head head = head_of(archive.out.data(), archive.out.size());
    const auto* first = reinterpret_cast<const uint8_t*>(&head);
    archive.out.insert(archive.out.begin(), first, first + sizeof head);
    return std::move(archive.out);
}

Snapshot snapshot_from(const uint8_t* bytes, size_t count) {
    Head head;
    if (count < sizeof head)
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot has %zu bytes, fewer than its header; pass all of it", count);
    std::memcpy(&head, bytes, sizeof head);
    bytes += sizeof head;
    count -= sizeof head;
    if (std::memcmp(head.magic, MAGIC, sizeof MAGIC) != 0)
        fail(FROND_RESULT_FILE_FORMAT, "this is not a snapshot; pass what frond_world_save wrote");
    if (head.length != count)
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot declares %llu bytes and has %zu; pass all of it and no more",
             static_cast<unsigned long long>(head.length), count);
    const Head own = head_of(bytes, count);
    if (std::memcmp(head.version, own.version, sizeof own.version) != 0 || head.layout != own.layout)
        fail(FROND_RESULT_FILE_FORMAT,
             "the snapshot is of another version of Frond than " FROND_VERSION_STRING "; save it anew with this one");
    if (head.precision != own.precision)
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot was made with a Bullet of %u bytes a number, this one has %u",
             head.precision, own.precision);
    if (head.checksum != own.checksum) fail(FROND_RESULT_FILE_FORMAT, "the snapshot is damaged; its checksum differs");
    Archive archive(bytes, count, {"the snapshot", "pass all bytes that frond_world_save wrote"});
    Snapshot snapshot;
    visit_all(archive, snapshot);
    if (!archive.is_at_end())
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot is longer than what it holds; it is damaged");
    return snapshot;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
