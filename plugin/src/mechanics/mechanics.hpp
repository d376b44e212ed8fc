// Mechanics: energy, force and exact stiffness of a body of elements; rows of a table indexed by frond_mechanics.
#pragma once

#include <memory>

#include "core/types.hpp"
#include "frond/frond.h"
#include "mechanics/block_matrix.hpp"
#include "mechanics/plasticity.hpp"
#include "mechanics/tet_nodes.hpp"
#include "model/model.hpp"

namespace frond {

// Rest data of a mechanics; read-only, shared by all plants of a model. A node is three numbers of x: a position or,
// where a mechanics says so, a rotation vector.
struct Elements {
    int node_count = 0;
    VecX rest_positions;  // nodes without load, node_count*3 [m]
    VecX modelled;        // nodes in the modelled shape, node_count*3 [m]
    BlockPattern pattern;
    std::vector<double> damping_ratio;  // damping ratio of each element's organ [-]
    std::vector<Yield> yields;          // one an element; empty if nothing can yield
    std::vector<int> section;           // capsule of each element, by the chain node at its end
    std::vector<double> breaking;       // strain at which each capsule breaks [-], 0: never; empty if nothing can
    virtual ~Elements() = default;

protected:
    Elements() = default;
    Elements(const Elements&) = default;
    Elements(Elements&&) = default;
    Elements& operator=(const Elements&) = default;
    Elements& operator=(Elements&&) = default;
};

// Plastic part of the deformation at an integration point: F = F_e F_p.
struct TetPlastic {
    Mat3 rest_inverse;  // the tet's, times F_p^-1 [1/m]
    Mat3 inverse;       // F_p^-1, of determinant one
    double hardening;   // see elastic_share()
};

// Nodes are the cage's and, with order 2, the middles of its edges. Edges may then be curved at rest, so that each
// integration point has its own volume and inverse.
struct TetElements : Elements {
    TetNodes nodes;
    std::vector<Tet> tets;     // the cage's tets
    std::vector<Tet> ordered;  // the same tets, nodes ascending: their blocks then lie in the lower triangle
    // Inverse of the edges (columns) from ordered[0] to ordered[1..3] at each integration point; by tets, points [1/m].
    std::vector<Mat3> rest_inverse;
    std::vector<double> volume;        // volume of each tet [m^3]
    std::vector<double> point_volume;  // volume that each integration point stands for, with order 2 only [m^3]
    std::vector<double> lambda, mu;    // Lame's constants [Pa]
    std::vector<double> density;       // [kg/m^3]
    std::vector<TetPlastic> plastic;   // by tets and points; empty unless the plant has yielded
    // E I length / reach^2 of each capsule's section, reach being the distance of its outermost fibre [J].
    std::vector<double> resistance;
    // Slots of the blocks of an element's nodes a >= b, as in nodes.of_tet, at [a(a+1)/2 + b]: 10 with order 1, else
    // 55.
    std::vector<std::array<int, 10>> slots;
    std::vector<std::array<int, 55>> quadratic_slots;
};

// Makes elements that rest as modelled, or in other rest positions if given (the rest shape found under gravity).
TetElements make_tet_elements(const Model& model, const VecX* rest_positions = nullptr, int order = 1);

// Masses of the nodes, and the mass matrix.
struct Masses {
    VecX node;                 // row sums of the matrix, one a node [kg]; zero for a rotation
    bool lumped = true;        // the mass matrix is diagonal
    std::vector<double> slot;  // one a block of the pattern, times the identity [kg]
};

// Derivative of the force: the exact one, or one that is always positive semi-definite.
enum class Tangent { exact, positive };

// Positions of which a stage begins at last + back (last - before), as x; null: it begins otherwise.
struct StageBase {
    const double *last = nullptr, *before = nullptr;
    double back = 0;
};

// Data by which a solve extrapolates to the end of a step.
struct Ahead {
    const double *way, *v;                       // displacement from there to where v leads [m], and v [m/s], as x
    double step;                                 // step of the stage [s]
    double damping;                              // stiffness-proportional, of all elements [s]
    const std::vector<double>& element_damping;  // and each element's own besides; empty: none [s]
    StageBase base = {};                         // for what damps by the change of strain from there
};

// Functions on a batch of plants: each number of a vector or a matrix is stored once a lane (core/lanes.hpp), and
// results are the same as for each plant alone.
struct BatchMechanics {
    // Sets f and A to what Mechanics::add_ahead adds, whatever they held; `filled` is scratch, and `seen` what
    // retract() needs of it again. Writes each lane's number of inverted tets to `inverted`.
    void (*set_ahead)(const Elements& elements, const NumbersInLines& x, const Ahead& ahead, NumbersInLines& f,
                      BlockMatrix& A, std::vector<uint8_t>& filled, NumbersInLines& seen, int* inverted);
    // Computes rotary inertia as in Mechanics, row by row; null: no node rotates.
    void (*rotary_inertia)(const Elements& elements, const NumbersInLines& x, NumbersInLines& out);
    // Return a bit for each lane in which is_calm() fails over that part of the displacement, or yields() holds, or
    // that is so close to such a limit that its plant has to be checked alone.
    unsigned (*not_calm)(const Elements& elements, const NumbersInLines& from, const NumbersInLines& to, double part);
    unsigned (*may_yield)(const Elements& elements, const NumbersInLines& x);  // null: retract() finds it on its way
    // As in Mechanics, after set_ahead() at `from`. Returns what may_yield() would return at the end.
    unsigned (*retract)(const Elements& elements, const NumbersInLines& from, const NumbersInLines& end,
                        const std::vector<uint8_t>& held, const NumbersInLines& seen, NumbersInLines& out) = nullptr;
};

// x is in the frame of the rest positions, so a plant's rotation in the world does not strain it.
struct Mechanics {
    const char* name = nullptr;
    // `which` is the row's own number.
    std::unique_ptr<const Elements> (*make)(const Model& model, frond_mechanics which) = nullptr;
    Masses (*masses)(const Elements& elements, frond_mass mass) = nullptr;
    // Returns the elastic energy at x [J].
    double (*energy)(const Elements& elements, const VecX& x) = nullptr;
    // Adds the elastic force at x, minus the gradient of the energy, to f [N]; returns the number of inverted tets.
    int (*add_force)(const Elements& elements, const VecX& x, VecX& f) = nullptr;
    // Adds scale times the stiffness at x, the second derivative of the energy, to K [N/m].
    void (*add_stiffness)(const Elements& elements, const VecX& x, Tangent tangent, double scale,
                          BlockMatrix& K) = nullptr;
    // Does both in one pass over the elements, the stiffness with scale one.
    int (*add_force_and_stiffness)(const Elements& elements, const VecX& x, Tangent tangent, VecX& f,
                                   BlockMatrix& K) = nullptr;
    // The same with the positive stiffness; also adds damping[e] [s] times each element's stiffness to D [N s/m].
    int (*add_force_stiffness_and_damping)(const Elements& elements, const VecX& x, const std::vector<double>& damping,
                                           VecX& f, BlockMatrix& K, BlockMatrix& D) = nullptr;
    // With K the positive stiffness at x and D its stiffness-proportional damping: adds the force at x minus K way
    // minus D v to f, and step^2 K + step D to A; returns the number of inverted tets. Null: use the functions above.
    // Rods damp by the change of strain from ahead.base instead of by v, where that is given.
    int (*add_ahead)(const Elements& elements, const VecX& x, const Ahead& ahead, VecX& f, BlockMatrix& A) = nullptr;
    // Computes the rotary inertia of each pair of nodes, position and rotation, by the rate of the rotation vector at x
    // [kg m^2]; null: no node rotates.
    void (*rotary_inertia)(const Elements& elements, const VecX& x, std::vector<Mat3>& out) = nullptr;
    // Returns whether all elements strain and rotate little between `from` and `to` (the trust bound), so that forces
    // and stiffness at `to` may be used for a step that begins at `from`.
    bool (*is_calm)(const Elements& elements, const VecX& from, const VecX& to) = nullptr;
    // Computes the derivative of a tet's forces on its n nodes by their rest positions [N/m]: of the force on a by the
    // position of b at [n a + b], nodes in the order of element_nodes(). Null where the rest shape is known without it.
    void (*rest_derivative)(const Elements& elements, size_t e, const VecX& x, std::vector<Mat3>& out) = nullptr;
    // Plasticity: returns whether an element is strained beyond its yield strain at x; needs `yields`.
    bool (*yields)(const Elements& elements, const VecX& x) = nullptr;
    // Copies the elements for a plant that has yielded.
    std::unique_ptr<Elements> (*copy)(const Elements& elements) = nullptr;
    // Makes the part of such a copy's deformation at x that yields or creeps within h [s] plastic; elastic energy does
    // not grow by it.
    void (*flow)(Elements& own, const VecX& x, double h) = nullptr;
    // Get and set the plastic state; set throws BAD_ARGUMENT, with nothing changed, for values that get cannot return.
    std::vector<double> (*get_plastic)(const Elements& own) = nullptr;
    void (*set_plastic)(Elements& own, const std::vector<double>& values) = nullptr;
    // Breaking: computes the strain of each capsule's outermost fibre at x, one a chain node [-].
    void (*section_strains)(const Elements& elements, const VecX& x, std::vector<double>& out) = nullptr;
    // Copies the elements without those of the capsules that are `gone`, one flag a chain node; the pattern stays.
    std::unique_ptr<Elements> (*without)(const Elements& elements, const std::vector<uint8_t>& gone) = nullptr;
    // A single solve may blow up where tets are inverted, and has to be continued with a line search.
    bool needs_search = false;
    // Share of the trust bound beyond which a step is asked for its energy even on its course: a straight way draws out
    // what turns, which stiff elements take for strain [-]; 0: none is.
    double asked_from = 0;
    // Nodes are pairs of a chain node's position and rotation, and the cage follows; else nodes are the cage's.
    bool moves_chain = false;
    // Rotations cause no strain; false for linear tets, which grow when they rotate far.
    bool turns = true;
    const BatchMechanics* batch = nullptr;  // null: plants are stepped one by one
    // Puts the end of a displacement that a solve found by linearizing at `from` back onto motions that strain elements
    // as the solve says: `out` is `end` but for that. Held nodes, one flag a node, stay. Null: `end` is good as it is.
    void (*retract)(const Elements& elements, const VecX& from, const VecX& end, const std::vector<uint8_t>& held,
                    VecX& out) = nullptr;
};
// Returns the row for elements of order 1 .. HIGHEST_ORDER; chain mechanics are the same for both orders.
const Mechanics& mechanics(frond_mechanics which, int order = 1);

}  // namespace frond
