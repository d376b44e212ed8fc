// Impulses of plants on the links of a multi-body, foreseen for Bullet's solver: motors and joint limits would
// otherwise undo in each step what plants did to a link, and press it through them.
//
// Bullet solves before plants step. So the impulses of the last step are scaled, link by link, until links go on as
// plants are foreseen to go on under them, with motors and limits at work; Bullet then solves with these impulses on
// the links. Before plants respond they are taken back, so that the response finds the impulses of both sides as they
// are; where they were foreseen, links go on with the velocities that Bullet found.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "world/lent.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// The loads of one multi-body. A constraint without rows, as these are called at the right place in Bullet's step.
class LinkLoads : public btMultiBodyConstraint {
public:
    LinkLoads(World& world, btMultiBody& body);
    btMultiBody* body() const { return m_bodyA; }
    // Returns what was given to the body in this step, as generalised impulses; nothing from then on.
    std::vector<btScalar> take_given();
    // What was taken back in this step.
    struct Taken {
        std::vector<btScalar> velocities;  // changes, one per velocity of the body; none if nothing was given
        double energy = 0;                 // that the body has by that [J]
    } taken;

    void finalizeMultiDof() override {}
    int getIslandIdA() const override;
    int getIslandIdB() const override { return -1; }
    // Gives the body the impulses.
    void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                              const btContactSolverInfo& info) override;
    void debugDraw(btIDebugDraw*) override {}

private:
    struct Load;
    struct Limits;
    std::vector<Load> find_loads() const;
    Eigen::MatrixXd find_compliance(const std::vector<Load>& loads) const;
    std::vector<Limits> find_limits(const btMultiBodyJacobianData& data, const btContactSolverInfo& info) const;
    void give(const std::vector<Load>& loads, const Eigen::VectorXd& impulses, btMultiBodyJacobianData& data);

    World& _world;
    std::vector<btScalar> _given;
};

// Has Bullet meet what is foreseen in its next step.
void lend_link_loads(World& world);
// Returns the loads of a multi-body; null if it has none.
const LinkLoads* find_link_loads(const World& world, const btMultiBody& body);
// Takes all loads out of Bullet's world.
void remove_link_loads(World& world);
// Forgets loads that the host deletes.
void host_deleted(World& world, LinkLoads& loads);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
