// The kernels: assembly, factorisations and solves of a corn plant and of a tree.
#include "kernels/kernels.hpp"

#include <filesystem>
#include <memory>

#include "frond/frond.h"
#include "grow/grow.hpp"
#include "modelling/build.hpp"
#include "solve/linear_solver.hpp"
#include "solve/solve.hpp"

namespace frond::kernels {

namespace {

constexpr double STEP = 1.0 / 60;  // [s]

// Data shared by the kernels of one plant with one mechanics: positions as modelled, forces, and M + h^2 K.
struct Body {
    std::shared_ptr<const Model> model;
    const Mechanics& row;
    std::unique_ptr<const Elements> elements;
    VecX f, way, v, b, x;
    std::vector<double> damping;
    BlockMatrix A;
    BlockPlan plan;
    LinearScratch scratch;
    LinearLimits limits = {1, 1e-8};

    Body(std::shared_ptr<const Model> made, frond_mechanics which, int order)
        : model(std::move(made)), row(mechanics(which, order)), elements(row.make(*model, which)) {
        const Eigen::Index numbers = 3 * elements->node_count;
        f = v = b = x = VecX::Zero(numbers);
        way = VecX::Constant(numbers, 1e-3);
        A.set_pattern(elements->pattern);
        assemble();
        const Masses masses = row.masses(*elements, FROND_MASS_LUMPED);
        for (int slot = 0; slot < elements->pattern.block_count(); ++slot)
            A.block(slot).diagonal().array() += masses.slot[size_t(slot)];
        // Rotations have no mass of their own.
        for (int node = 0; row.moves_chain && node < elements->node_count; ++node)
            A.block(elements->pattern.start[size_t(node)]).diagonal().array() += 1e-9;
        plan = make_block_plan(elements->pattern);
        scratch.block.plan = &plan;
        b.setOnes();
    }
    void assemble() {
        f.setZero();
        A.set_zero();
        const Ahead ahead = {way.data(), v.data(), STEP, 0, damping};
        if (row.add_ahead)
            row.add_ahead(*elements, elements->modelled, ahead, f, A);
        else
            row.add_force_and_stiffness(*elements, elements->modelled, Tangent::positive, f, A);
    }
};

void add_assembly(const std::string& plant, const std::string& pieces, size_t count, const std::shared_ptr<Body>& body,
                  std::vector<Kernel>& all) {
    all.push_back({plant + "/assembly of " + pieces, count, [body] { body->assemble(); }});
}

void add_solver(const std::string& plant, const std::string& name, const std::shared_ptr<Body>& body,
                frond_linear_solver which, std::vector<Kernel>& all) {
    const size_t blocks = size_t(body->elements->pattern.block_count());
    // The residual is left out, as it is the same for all solvers.
    if (which == FROND_LINEAR_SOLVER_BLOCK) {
        all.push_back({plant + "/factor, " + name, blocks, [body] { factorize(body->scratch.block, body->A); }});
        all.push_back({plant + "/solve, " + name, blocks, [body] { solve(body->scratch.block, body->b, body->x); }});
    } else {
        all.push_back({plant + "/factor, " + name, blocks, [body] { factorize(*body->scratch.direct, body->A); }});
        all.push_back({plant + "/solve, " + name, blocks, [body] { solve(*body->scratch.direct, body->b, body->x); }});
    }
}

void add_kernels(const std::string& plant, const std::shared_ptr<const Model>& model, std::vector<Kernel>& all) {
    const size_t tets = model->cage.tets.size();
    const auto corotational = std::make_shared<Body>(model, FROND_MECHANICS_TET_COROTATIONAL, 1);
    corotational->scratch.direct = make_direct_factor(corotational->elements->pattern);
    add_assembly(plant, "corotational tets", tets, corotational, all);
    add_assembly(plant, "linear tets", tets, std::make_shared<Body>(model, FROND_MECHANICS_TET_LINEAR, 1), all);
    add_assembly(plant, "neo-Hookean tets", tets, std::make_shared<Body>(model, FROND_MECHANICS_TET_NEOHOOKEAN, 1),
                 all);
    add_solver(plant, "tets, block", corotational, FROND_LINEAR_SOLVER_BLOCK, all);
    add_solver(plant, "tets, direct (Eigen)", corotational, FROND_LINEAR_SOLVER_DIRECT, all);
    all.push_back({plant + "/residual, tets", size_t(corotational->elements->pattern.block_count()), [corotational] {
                       Body& body = *corotational;
                       relative_residual(body.A, body.b, body.x, body.scratch.residual);
                   }});
    const auto rods = std::make_shared<Body>(model, FROND_MECHANICS_ROD, 1);
    add_assembly(plant, "rods", model->chain.nodes.size(), rods, all);
    add_solver(plant, "rods, block", rods, FROND_LINEAR_SOLVER_BLOCK, all);
}

}  // namespace

std::vector<Kernel> make_kernels() {
    std::vector<Kernel> all;
    frond_model_def def = frond_default_model_def();
    add_kernels("corn", build_from_file(FROND_SOURCE_DIR "/models/corn/corn.obj", def), all);
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "frond_kernels";
    def.cage_size = 0.1;  // [m]
    const std::string tree = grow::write_obj(grow::grow_plant("tree", {{"leaves", 400}}), folder.string());
    add_kernels("tree", build_from_file(tree, def), all);
    std::filesystem::remove_all(folder);
    return all;
}

}  // namespace frond::kernels
