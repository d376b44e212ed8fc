// In: contacts of links that are foreseen, and a multi-body's motors and limits. Out: impulses on its links.
#include "world/link_loads.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>

#include <algorithm>

#include "world/convert.hpp"
#include "world/is_in.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

using Generalised = std::vector<btScalar>;  // one per velocity of the multi-body

double dot(const Generalised& a, const btScalar* b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); i++) sum += double(a[i]) * double(b[i]);
    return sum;
}

// Calls `take` for all that is foreseen of the links of a multi-body, but for links that are gone.
template <class Take>
void for_each_foreseen(const World& world, const btMultiBody& body, const Take& take) {
    const auto take_one = [&](const Foreseen& foreseen, const btCollisionObject* object) {
        if (foreseen.parts.empty() || !is_in(*world.bullet, object)) return;
        const btMultiBodyLinkCollider* link = btMultiBodyLinkCollider::upcast(object);
        if (link && link->m_multiBody == &body) take(foreseen, *link);
    };
    for (const Contact& contact : world.contacts) take_one(contact.foreseen, contact.other);
    for (const Bond& bond : world.bonds) take_one(bond.foreseen, bond.body);
}

// A boxed linear complementarity problem: compliance x = wanted + w, where x is at its least and w is not below zero,
// or x is at its most and w not above zero, or w is zero.
struct Complementarity {
    Eigen::MatrixXd compliance;
    Eigen::VectorXd wanted, least, most;
};

// Solves it by Dantzig's method, which is exact; zero if it has no solution.
Eigen::VectorXd solve(const Complementarity& problem) {
    constexpr double REGULAR = 1e-6;  // what is added to the diagonal, over its mean: motors and limits are one [-]
    const Eigen::Index count = problem.wanted.size();
    Eigen::MatrixXd compliance = problem.compliance;
    compliance.diagonal().array() += REGULAR * compliance.trace() / double(count);
    using Vector = Eigen::Matrix<btScalar, Eigen::Dynamic, 1>;
    Eigen::Matrix<btScalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> a = compliance.cast<btScalar>();
    Vector b = problem.wanted.cast<btScalar>(), low = problem.least.cast<btScalar>(),
           high = problem.most.cast<btScalar>(), x = Vector::Zero(count), w = Vector::Zero(count);
    std::vector<int> alone(size_t(count), -1);
    btDantzigScratchMemory scratch;
    const bool is_solved = btSolveDantzigLCP(int(count), a.data(), x.data(), b.data(), w.data(), 0, low.data(),
                                             high.data(), alone.data(), scratch);
    return is_solved && x.allFinite() ? Eigen::VectorXd(x.cast<double>()) : Eigen::VectorXd::Zero(count);
}

}  // namespace

// All impulses of a kind on a link, which are scaled alike.
struct LinkLoads::Load {
    Foreseen::Load of;
    double impulse = 0;         // sum of the sizes of impulses [N s]
    double work = 0;            // as in Foreseen [J]
    double most_friction = 0;   // likewise [N s]
    Generalised of_unit;        // generalised impulse of one that has the size of one, in the same proportions
    Generalised response = {};  // velocities by that
};

// A row of Bullet's solver: a motor, a joint limit or another constraint of the body.
struct LinkLoads::Limits {
    Generalised of_unit, response;
    double own;          // velocity by a unit impulse, also of another body [1/kg]
    double wanted;       // change of velocity [m/s]
    double least, most;  // impulses [N s]
};

LinkLoads::LinkLoads(World& world, btMultiBody& body)
    : btMultiBodyConstraint(&body, nullptr, -1, -1, 0, true, MULTIBODY_CONSTRAINT_POINT_TO_POINT), _world(world) {}

int LinkLoads::getIslandIdA() const {
    int id = -1;
    for_each_foreseen(_world, *m_bodyA, [&](const Foreseen&, const btMultiBodyLinkCollider& link) {
        id = std::max(id, link.getIslandTag());
    });
    return id;
}

std::vector<LinkLoads::Load> LinkLoads::find_loads() const {
    std::vector<Load> loads;
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    btAlignedObjectArray<btMatrix3x3> m;
    Generalised jacobian;
    const auto find = [&](const Foreseen::Load& of) -> Load& {
        for (Load& load : loads)
            if (load.of == of) return load;
        return loads.emplace_back(Load{of, 0, 0, 0, Generalised(jacobian.size(), 0), {}});
    };
    for_each_foreseen(_world, *m_bodyA, [&](const Foreseen& foreseen, const btMultiBodyLinkCollider& link) {
        for (const Foreseen::Part& part : foreseen.parts) {
            const double size = part.impulse.norm();
            if (!(size > 0)) continue;
            jacobian.resize(size_t(m_bodyA->getNumDofs()) + 6);
            Load& load = find({link.m_link, part.kind});
            m_bodyA->fillContactJacobianMultiDof(link.m_link, link.getWorldTransform() * to_bullet(foreseen.place),
                                                 to_bullet(-part.impulse / size), jacobian.data(), r, v, m);
            load.impulse += size;
            load.work += part.work;
            load.most_friction += foreseen.most_friction;
            for (size_t k = 0; k < jacobian.size(); k++) load.of_unit[k] += btScalar(size) * jacobian[k];
        }
    });
    for (Load& load : loads) {
        for (btScalar& of : load.of_unit) of /= btScalar(load.impulse);
        load.response.resize(load.of_unit.size());
        m_bodyA->calcAccelerationDeltasMultiDof(load.of_unit.data(), load.response.data(), r, v);
    }
    return loads;
}

// Returns how plants give way to the loads, as velocities at each by a unit impulse of each [1/kg].
Eigen::MatrixXd LinkLoads::find_compliance(const std::vector<Load>& loads) const {
    const auto number_of = [&](const Foreseen::Load& of) {
        const auto is_it = [&](const Load& load) { return load.of == of; };
        return size_t(std::find_if(loads.begin(), loads.end(), is_it) - loads.begin());
    };
    Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(Eigen::Index(loads.size()), Eigen::Index(loads.size()));
    for_each_foreseen(_world, *m_bodyA, [&](const Foreseen& foreseen, const btMultiBodyLinkCollider& link) {
        for (const Foreseen::Part& part : foreseen.parts)
            for (const Foreseen::Give& give : part.gives) {
                const size_t at = number_of({link.m_link, part.kind}), by = number_of(give.to);
                if (at == loads.size() || by == loads.size()) continue;  // what pushed is gone
                compliance(Eigen::Index(at), Eigen::Index(by)) += give.work / (loads[at].impulse * loads[by].impulse);
            }
    });
    return 0.5 * (compliance + compliance.transpose());
}

// Has the body's other constraints make the rows that Bullet is about to solve.
std::vector<LinkLoads::Limits> LinkLoads::find_limits(const btMultiBodyJacobianData& data,
                                                      const btContactSolverInfo& info) const {
    std::vector<Limits> limits;
    auto& bullet = dynamic_cast<btMultiBodyDynamicsWorld&>(*_world.bullet);
    btMultiBodyConstraintArray rows;
    btMultiBodyJacobianData own;
    own.m_solverBodyPool = data.m_solverBodyPool;
    own.m_fixedBodyId = data.m_fixedBodyId;
    for (int i = 0; i < bullet.getNumMultiBodyConstraints(); i++) {
        btMultiBodyConstraint& constraint = *bullet.getMultiBodyConstraint(i);
        btMultiBody *const a = constraint.getMultiBodyA(), *const b = constraint.getMultiBodyB();
        if (&constraint == this || (a != m_bodyA && b != m_bodyA)) continue;
        // A body's place among the solver's velocities, which are not to be changed.
        const int place_of_a = a ? a->getCompanionId() : -1, place_of_b = b ? b->getCompanionId() : -1;
        for (btMultiBody* body : {a, b})
            if (body) body->setCompanionId(-1);
        constraint.createConstraintRows(rows, own, info);
        if (a) a->setCompanionId(place_of_a);
        if (b) b->setCompanionId(place_of_b);
    }
    const size_t size = size_t(m_bodyA->getNumDofs()) + 6;
    for (int i = 0; i < rows.size(); i++) {
        const btMultiBodySolverConstraint& row = rows[i];
        if (!(row.m_jacDiagABInv > 0)) continue;
        Limits of = {Generalised(size, 0), Generalised(size, 0), 1 / double(row.m_jacDiagABInv), 0, 0, 0};
        const auto add = [&](const btMultiBody* body, int begin) {
            for (size_t k = 0; body == m_bodyA && k < size; k++) {
                of.of_unit[k] += own.m_jacobians[begin + int(k)];
                of.response[k] += own.m_deltaVelocitiesUnitImpulse[begin + int(k)];
            }
        };
        add(row.m_multiBodyA, row.m_jacAindex);
        add(row.m_multiBodyB, row.m_jacBindex);
        of.wanted = double(row.m_rhs) * of.own;
        of.least = double(row.m_lowerLimit);
        of.most = double(row.m_upperLimit);
        limits.push_back(std::move(of));
    }
    return limits;
}

void LinkLoads::createConstraintRows(btMultiBodyConstraintArray&, btMultiBodyJacobianData& data,
                                     const btContactSolverInfo& info) {
    _given.clear();
    const std::vector<Load> loads = find_loads();
    if (loads.empty()) return;
    const std::vector<Limits> limits = find_limits(data, info);
    if (limits.empty()) return;  // nothing undoes what plants did
    // Bullet's velocities and responses of loads, then of limits. What is asked for counts from the loads as foreseen.
    std::vector<const Generalised*> units, responses;
    for (const Load& load : loads) units.push_back(&load.of_unit), responses.push_back(&load.response);
    for (const Limits& limit : limits) units.push_back(&limit.of_unit), responses.push_back(&limit.response);
    const Eigen::Index count = Eigen::Index(units.size()), load_count = Eigen::Index(loads.size());
    Complementarity problem = {Eigen::MatrixXd(count, count), Eigen::VectorXd(count), Eigen::VectorXd(count),
                               Eigen::VectorXd(count)};
    for (Eigen::Index i = 0; i < count; i++)
        for (Eigen::Index k = 0; k < count; k++)
            problem.compliance(i, k) = dot(*units[size_t(i)], responses[size_t(k)]->data());
    Eigen::VectorXd impulses(load_count);
    for (Eigen::Index i = 0; i < load_count; i++) {
        const Load& load = loads[size_t(i)];
        impulses[i] = load.impulse;
        problem.wanted[i] = -load.work / load.impulse - dot(load.of_unit, m_bodyA->getVelocityVector());
        const double most =
            Foreseen::is_friction(load.of.kind) ? std::max(load.most_friction, load.impulse) : BT_LARGE_FLOAT;
        problem.most[i] = most - load.impulse;
        problem.least[i] = (load.of.kind == Foreseen::Kind::normal ? 0 : -most) - load.impulse;
    }
    for (Eigen::Index i = load_count; i < count; i++) {
        const Limits& limit = limits[size_t(i - load_count)];
        problem.wanted[i] = limit.wanted;
        problem.least[i] = limit.least;
        problem.most[i] = limit.most;
    }
    problem.wanted -= problem.compliance.leftCols(load_count) * impulses;
    for (Eigen::Index i = load_count; i < count; i++) problem.compliance(i, i) = limits[size_t(i - load_count)].own;
    problem.compliance.topLeftCorner(load_count, load_count) += find_compliance(loads);
    impulses += solve(problem).head(load_count);
    give(loads, impulses, data);
}

// Adds impulses to the velocities with which the solver begins.
void LinkLoads::give(const std::vector<Load>& loads, const Eigen::VectorXd& impulses, btMultiBodyJacobianData& data) {
    const int size = m_bodyA->getNumDofs() + 6;
    _given.assign(size_t(size), 0);
    Generalised change(size_t(size), 0);
    for (size_t i = 0; i < loads.size(); i++)
        for (size_t k = 0; k < size_t(size); k++) {
            _given[k] += btScalar(impulses[Eigen::Index(i)]) * loads[i].of_unit[k];
            change[k] += btScalar(impulses[Eigen::Index(i)]) * loads[i].response[k];
        }
    if (m_bodyA->getCompanionId() < 0) {
        m_bodyA->setCompanionId(data.m_deltaVelocities.size());
        data.m_deltaVelocities.resize(data.m_deltaVelocities.size() + size, 0);
    }
    applyDeltaVee(data, change.data(), 1, m_bodyA->getCompanionId(), size);
#ifdef DIRECTLY_UPDATE_VELOCITY_DURING_SOLVER_ITERATIONS
    m_bodyA->applyDeltaVeeMultiDof2(change.data(), 1);
#endif
}

std::vector<btScalar> LinkLoads::take_given() {
    return std::exchange(_given, {});
}

void lend_link_loads(World& world) {
    auto* bullet = dynamic_cast<btMultiBodyDynamicsWorld*>(world.bullet);
    // Bullet's direct solvers do not see with what velocities they begin.
    if (!bullet || bullet->getConstraintSolver()->getSolverType() == BT_MLCP_SOLVER) return;
    std::vector<btMultiBody*> bodies;  // that are pushed
    const auto add = [&](const Foreseen& foreseen, btCollisionObject* object) {
        btMultiBodyLinkCollider* link = foreseen.parts.empty() ? nullptr : btMultiBodyLinkCollider::upcast(object);
        if (link) bodies.push_back(link->m_multiBody);
    };
    for (const Contact& contact : world.contacts) add(contact.foreseen, contact.other);
    for (const Bond& bond : world.bonds) add(bond.foreseen, bond.body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (size_t i = world.link_loads.size(); i-- > 0;) {
        const auto place = std::find(bodies.begin(), bodies.end(), world.link_loads[i]->body());
        if (place != bodies.end()) {
            bodies.erase(place);
            continue;
        }
        bullet->removeMultiBodyConstraint(world.link_loads[i].get());
        world.link_loads.erase(world.link_loads.begin() + std::ptrdiff_t(i));
    }
    for (btMultiBody* body : bodies) {
        world.link_loads.push_back(lend<LinkLoads>(world, world, *body));
        bullet->addMultiBodyConstraint(world.link_loads.back().get());
    }
}

const LinkLoads* find_link_loads(const World& world, const btMultiBody& body) {
    for (const auto& loads : world.link_loads)
        if (loads->body() == &body) return loads.get();
    return nullptr;
}

void remove_link_loads(World& world) {
    for (Contact& contact : world.contacts) contact.foreseen = {};
    for (Bond& bond : world.bonds) bond.foreseen = {};
    lend_link_loads(world);
}

void host_deleted(World& world, LinkLoads& loads) {
    const auto place = std::find_if(world.link_loads.begin(), world.link_loads.end(),
                                    [&](const auto& lent) { return lent.get() == &loads; });
    leave_to_host(*place);
    world.link_loads.erase(place);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
