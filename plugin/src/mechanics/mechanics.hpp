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

// The rest data of a mechanics; read-only, shared by all plants of a model. Its nodes are blocks of three numbers of
// x: places or, where a mechanics says so, rotation vectors.
struct Elements {
    int node_count = 0;
    VecX rest_positions;  // without load, node_count*3 [m]
    VecX modelled;        // where the nodes are in the shape that was modelled, node_count*3 [m]
    BlockPattern pattern;
    std::vector<double> damping_ratio;  // of the organ that each element belongs to [-]
    std::vector<Yield> yields;          // one an element; none where nothing can yield
    std::vector<int> section;           // the capsule that each element belongs to, by the chain node at its end
    std::vector<double> breaking;       // strain at which each capsule breaks [-], 0: never; none where nothing can
    virtual ~Elements() = default;

protected:
    Elements() = default;
    Elements(const Elements&) = default;
    Elements(Elements&&) = default;
    Elements& operator=(const Elements&) = default;
    Elements& operator=(Elements&&) = default;
};

// The plastic part of the deformation at a point of integration: F = F_e F_p.
struct TetPlastic {
    Mat3 rest_inverse;  // the tet's, times F_p^-1 [1/m]
    Mat3 inverse;       // F_p^-1, of determinant one
    double hardening;   // see elastic_share()
};

// Nodes are the cage's, with order 2 the middles of its edges too. At rest those edges may be curved, so that each of
// an element's points of integration has a volume and an inverse of its own.
struct TetElements : Elements {
    TetNodes nodes;
    std::vector<Tet> tets;     // as in the cage
    std::vector<Tet> ordered;  // the same tets, nodes ascending: their blocks then fall in the lower triangle
    // Inverse of the edges from ordered[0] to ordered[1..3], as columns, as points see them; by tets and points [1/m].
    std::vector<Mat3> rest_inverse;
    std::vector<double> volume;        // [m^3]
    std::vector<double> point_volume;  // with order 2 the shares of a tet's points in its volume, else none [m^3]
    std::vector<double> lambda, mu;    // Lame's constants [Pa]
    std::vector<double> density;       // [kg/m^3]
    std::vector<TetPlastic> plastic;   // by tets and their points; of a plant that has yielded, else none
    // E I length / reach^2 of each capsule's section, reach being that of its outermost fibre [J].
    std::vector<double> resistance;
    // Blocks of an element's nodes a >= b, in the order of nodes.of_tet, at [a(a+1)/2 + b] in a BlockMatrix of this
    // pattern: ten with order 1, else 55.
    std::vector<std::array<int, 10>> slots;
    std::vector<std::array<int, 55>> quadratic_slots;
};

// For rest positions of the nodes other than as modelled (the rest shape found under gravity), pass them.
TetElements make_tet_elements(const Model& model, const VecX* rest_positions = nullptr, int order = 1);

// Mass of the nodes.
struct Masses {
    VecX node;                 // sums of the matrix's rows, one a node [kg]; zero for a rotation
    bool lumped = true;        // the mass matrix is diagonal
    std::vector<double> slot;  // one a block of the pattern, times the identity [kg]
};

// Which derivative of the force: the exact one, or one that is always positive semi-definite.
enum class Tangent { exact, positive };

// The data of one solve about the end of a step.
struct Ahead {
    const double *way, *v;                       // numbers as x: from there to where v leads [m], and v [m/s]
    double step;                                 // [s]
    double damping;                              // times the stiffness: of all elements [s],
    const std::vector<double>& element_damping;  // and beside that of each; empty: none [s]
};

// The functions that work on several plants as a batch: each number of a vector or a matrix is there once a lane
// (core/lanes.hpp), and comes out as if its plant were alone.
struct BatchMechanics {
    // As in Mechanics.
    // f and A hold anything before; `filled` is room for it. Each lane's number of inverted tets is put to `inverted`.
    void (*set_ahead)(const Elements& elements, const NumbersInLines& x, const Ahead& ahead, NumbersInLines& f,
                      BlockMatrix& A, std::vector<uint8_t>& filled, int* inverted);
    // Row by row; null: no node turns.
    void (*rotary_inertia)(const Elements& elements, const NumbersInLines& x, NumbersInLines& out);
    // Which lanes are not, on that part of the way, as is_calm() asks, and not as yields() does, or so near to that
    // that they have to be asked themselves; a bit each.
    unsigned (*not_calm)(const Elements& elements, const NumbersInLines& from, const NumbersInLines& to, double part);
    unsigned (*may_yield)(const Elements& elements, const NumbersInLines& x);
};

// x is in the frame of the rest positions: a plant that is placed turned in a world is not bent by that.
struct Mechanics {
    const char* name;
    // `which` is the row's own number.
    std::unique_ptr<const Elements> (*make)(const Model& model, frond_mechanics which);
    Masses (*masses)(const Elements& elements, frond_mass mass);
    // Elastic energy at x [J].
    double (*energy)(const Elements& elements, const VecX& x);
    // Adds the elastic force at x, minus the gradient of the energy, to f [N]; the number of inverted tets is returned.
    int (*add_force)(const Elements& elements, const VecX& x, VecX& f);
    // Adds scale times the stiffness at x, the second derivative of the energy, to K [N/m].
    void (*add_stiffness)(const Elements& elements, const VecX& x, Tangent tangent, double scale, BlockMatrix& K);
    // Both of the above in one pass over the elements, the stiffness with scale one.
    int (*add_force_and_stiffness)(const Elements& elements, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K);
    // The same with the positive stiffness, and damping[e] [s] times each element's own part of it added to D [N s/m].
    int (*add_force_stiffness_and_damping)(const Elements& elements, const VecX& x, const std::vector<double>& damping,
                                           VecX& f, BlockMatrix& K, BlockMatrix& D);
    // With K the positive stiffness at x and D what it damps by: adds the force at x less K way and D v to f, and
    // step^2 K + step D to A; the number of inverted tets is returned. Null: the functions above do as well.
    int (*add_ahead)(const Elements& elements, const VecX& x, const Ahead& ahead, VecX& f, BlockMatrix& A);
    // Rotary inertia of each pair of nodes, place and rotation, by the rate of the rotation vector at x [kg m^2]; null
    // where no node turns.
    void (*rotary_inertia)(const Elements& elements, const VecX& x, std::vector<Mat3>& out);
    // Tells whether all elements are strained and turned little on the way, so that forces and stiffness at `to` are
    // worth taking for a step that begins at `from`.
    bool (*is_calm)(const Elements& elements, const VecX& from, const VecX& to);
    // Derivative of a tet's forces on its n nodes by their places at rest [N/m]: of the force on a by a move of b at
    // [n a + b], nodes in the order of element_nodes(). Null where the rest shape is known without it.
    void (*rest_derivative)(const Elements& elements, size_t e, const VecX& x, std::vector<Mat3>& out);
    // Plasticity. Whether something is strained beyond its yield at x; elements without `yields` are not to be asked.
    bool (*yields)(const Elements& elements, const VecX& x);
    // For a plant of its own that has yielded.
    std::unique_ptr<Elements> (*copy)(const Elements& elements);
    // Makes plastic the part of such a copy's deformation at x that yields or creeps within h [s]. Elastic energy does
    // not grow by it.
    void (*flow)(Elements& own, const VecX& x, double h);
    // All that is lasting, in numbers; set throws BAD_ARGUMENT, with nothing changed, for what get cannot have given.
    std::vector<double> (*get_plastic)(const Elements& own);
    void (*set_plastic)(Elements& own, const std::vector<double>& values);
    // Breaking. The strain of each capsule's outermost fibre at x, one a chain node [-].
    void (*section_strains)(const Elements& elements, const VecX& x, std::vector<double>& out);
    // A copy without the elements of the capsules that are gone, one flag a chain node; the pattern stays.
    std::unique_ptr<Elements> (*without)(const Elements& elements, const std::vector<uint8_t>& gone);
    // One solve alone may blow up where tets are inside out: go on from there with a line search.
    bool needs_search;
    // Nodes are pairs of a chain node's place and its rotation; the cage follows. Else nodes are the cage's.
    bool moves_chain;
    // Turning strains nothing. What is linear grows when it turns far.
    bool turns = true;
    const BatchMechanics* batch = nullptr;  // null: plants go one by one
};
// With elements of order 1 .. HIGHEST_ORDER; what moves the chain is the same in both.
const Mechanics& mechanics(frond_mechanics which, int order = 1);

}  // namespace frond
