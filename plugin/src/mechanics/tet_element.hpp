// The two elements: tets whose displacements are linear (four nodes) or quadratic (ten). Deformation gradient at each
// integration point, and force and stiffness distributed to the nodes.
//
// At one point a quadratic tet is a linear one whose corners y are sums of its ten nodes,
//   y_c = (4 L_c - 1) x_c + 4 sum over d of L_d x_cd,
// L being the point's barycentric coordinates and x_cd the middle of edge cd: these are the gradients of the shape
// functions L (2 L - 1) and 4 L L' (Zienkiewicz, Taylor 2000, "The finite element method"). So materials see linear
// tets only. Four points at L = (a, b, b, b), a = (5 + 3 sqrt 5)/20, integrate squares of their gradients exactly
// (Hammer, Marlowe, Stroud 1956).
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// Sets another rest shape, node_count*3 [m].
void set_rest_positions(TetElements& elements, const VecX& rest_positions);

// Nodes of a tet's element, ascending.
struct ElementNodes {
    const int* node;
    size_t count;
};
inline ElementNodes element_nodes(const TetElements& elements, size_t e) {
    if (elements.nodes.order == 1) return {elements.ordered[e].data(), 4};
    return {elements.nodes.of_tet[e].data(), 10};
}
// Returns a node's share of its tet's lumped mass.
double lumped_share(int order, size_t node);
// Computes the derivative of a tet's rest volume by the rest positions of its nodes [m^2].
void volume_slopes(const TetElements& elements, size_t e, std::vector<Vec3>& out);

// Casts elements to those of tets.
inline const TetElements& as_tets(const Elements& elements) {
    return static_cast<const TetElements&>(elements);
}

// Input of a material: the share of a tet that one integration point stands for.
struct TetShare {
    const Mat3& rest_inverse;
    double volume, lambda, mu;
    const Vec3& axis;  // of the fibres at rest
    double grain;      // their modulus over mu [-]
};

// Returns the stretch of the fibres for a small gradient of displacements [-].
inline double stretch_along(const TetShare& share, const Mat3& gradient) {
    return share.axis.dot(gradient * share.axis);
}

// Returns Young's modulus by Lame's constants [Pa].
inline double young_of(double lambda, double mu) {
    return mu * (3 * lambda + 2 * mu) / (lambda + mu);
}

inline const Mat3& rest_inverse(const TetElements& elements, size_t e, int q, int points) {
    const size_t at = e * size_t(points) + size_t(q);
    return elements.plastic.empty() ? elements.rest_inverse[at] : elements.plastic[at].rest_inverse;
}

// Stiffness between corners 1, 2, 3 of a linear tet; corner 0 follows, since a translation gives no force.
struct TetStiffness {
    Mat3 k11, k21, k31, k22, k32, k33;
};

struct LinearTet {
    static constexpr int POINTS = 1, NODES = 4;  // T4
    using Places = Mat3;                         // edges from the first corner

    static TetShare share(const TetElements& elements, size_t e, int q = 0) {
        return {rest_inverse(elements, e, q, POINTS), elements.volume[e], elements.lambda[e], elements.mu[e],
                elements.grain_axis[e],                 elements.grain[e]};
    }

    static Places places(const TetElements& elements, size_t e, const VecX& x) {
        const Tet& tet = elements.ordered[e];
        const Vec3 x0 = point(x, tet[0]);
        Mat3 edges;
        for (int a = 0; a < 3; ++a) edges.col(a) = point(x, tet[size_t(a) + 1]) - x0;
        return edges;
    }

    // Returns the edges from the first corner of the linear tet at a point.
    static Mat3 edges(const Places& places, int) { return places; }
    // Returns F = sum over nodes of x b^T, with b the rest gradients of the shape functions.
    static Mat3 gradient(const TetShare& share, const Places& edges, int) { return edges * share.rest_inverse; }
    // Adds a point's blocks between the corners of its linear tet, 16 by rows, to the blocks between nodes; the other
    // adds a point's values at corners to the values at nodes.
    static void add_to_nodes(int, const std::array<Mat3, 16>& corners, std::vector<Mat3>& out) {
        for (size_t k = 0; k < 16; ++k) out[k] += corners[k];
    }
    static void add_to_nodes(int, const std::array<Vec3, 4>& corners, std::vector<Vec3>& out) {
        for (size_t k = 0; k < 4; ++k) out[k] += corners[k];
    }
};

struct QuadraticTetElement {
    static constexpr int POINTS = 4, NODES = 10;                                          // T10
    static constexpr double NEAR = 0.58541019662496845446, FAR = 0.13819660112501051518;  // a and b
    // Weights in a corner's y: of its own node, of its edges' nodes, and the excess of the node between it and corner q
    // at point q.
    static constexpr double CORNER = 4 * FAR - 1, EDGE = 4 * FAR, MORE = 4 * (NEAR - FAR);

    // Positions relative to the first corner.
    struct Places {
        std::array<Vec3, 10> node;
        std::array<Vec3, 4> corner;  // y without the excess
    };

    static TetShare share(const TetElements& elements, size_t e, int q) {
        const size_t at = POINTS * e + size_t(q);
        return {rest_inverse(elements, e, q, POINTS), elements.point_volume[at], elements.lambda[e],
                elements.mu[e],                       elements.grain_axis[at],   elements.grain[e]};
    }

    static Places places(const TetElements& elements, size_t e, const VecX& x) {
        const QuadraticTet& tet = elements.nodes.of_tet[e];
        const Vec3 x0 = point(x, tet[0]);
        Places places;
        for (size_t n = 0; n < 10; ++n) places.node[n] = point(x, tet[n]) - x0;
        for (size_t c = 0; c < 4; ++c) {
            places.corner[c] = CORNER * places.node[c];
            for (size_t d = 0; d < 4; ++d)
                if (d != c) places.corner[c] += EDGE * places.node[size_t(TET_BETWEEN[c][d])];
        }
        return places;
    }

    static Mat3 edges(const Places& places, int q) {
        const auto corner = [&](size_t c) {
            return Vec3(places.corner[c] + MORE * places.node[size_t(TET_BETWEEN[c][q])]);
        };
        const Vec3 y0 = corner(0);
        Mat3 edges;
        for (int a = 0; a < 3; ++a) edges.col(a) = corner(size_t(a) + 1) - y0;
        return edges;
    }

    static Mat3 gradient(const TetShare& share, const Places& places, int q) {
        return edges(places, q) * share.rest_inverse;
    }

    static void add_to_nodes(int q, const std::array<Mat3, 16>& corners, std::vector<Mat3>& out);
    static void add_to_nodes(int q, const std::array<Vec3, 4>& corners, std::vector<Vec3>& out);
};

// Calls `take(share, gradient)` with the gradient of a nodal field at each integration point of a tet.
template <class Take>
void take_gradients(const TetElements& elements, size_t e, const VecX& x, Take&& take) {
    const auto with = [&](auto element) {
        using Element = decltype(element);
        const auto places = Element::places(elements, e, x);
        for (int q = 0; q < Element::POINTS; ++q) {
            const TetShare share = Element::share(elements, e, q);
            take(share, Element::gradient(share, places, q));
        }
    };
    if (elements.nodes.order == 1)
        with(LinearTet());
    else
        with(QuadraticTetElement());
}

}  // namespace frond
