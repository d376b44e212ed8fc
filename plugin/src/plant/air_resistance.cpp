// In: a piece of an organ, how it is turned and the air that passes it. Out: force over velocity.
//
// The air's pressure follows the part of its velocity across a stem's axis or along a blade's normal, as if there were no
// other (Hoerner 1965; Taylor 1952, "Analysis of the swimming of long and narrow animals"): F = rho/2 Cd A u |u|. So the drag of
// a blade that is bent down the wind falls as Gosselin, de Langre, Machado-Almeida 2010 measured.
//   cylinder  Cd = 1 + 10 Re^(-2/3)                       (White 1991, "Viscous fluid flow")
//   sphere    Cd = 24 / Re + 6 / (1 + sqrt Re) + 0.4      (the same); both up to Re = 2e5
// The skin is rubbed as a flat plate: 1.328 / sqrt Re of either side (Blasius 1908).
#include <cmath>

#include "plant/air.hpp"

namespace frond {

namespace {

constexpr double VISCOSITY = 1.5e-5;  // of air, kinematic [m^2/s]

double cylinder_coefficient(double Re) {
    return 1 + 10 / std::cbrt(Re * Re);
}
double sphere_coefficient(double Re) {
    return 24 / Re + 6 / (1 + std::sqrt(Re)) + 0.4;
}

// rho/2 Cd A |u|, the area as it is seen along u: exact for an ellipse and for an ellipsoid.
double pressure(const AirPiece& piece, const Vec3& local, double density) {
    constexpr double STILL = 1e-9;  // [m/s]
    const double speed = local.norm();
    if (!(speed > STILL)) return 0;
    double coefficient = piece.coefficient;
    if (coefficient == 0) {
        const double Re = speed * piece.size / VISCOSITY;
        coefficient = piece.shape == AirShape::COMPACT ? sphere_coefficient(Re) : cylinder_coefficient(Re);
    }
    return 0.5 * density * coefficient * piece.area.cwiseProduct(local).norm();
}

// Of air that goes along the skin.
double friction(const AirPiece& piece, double along, double across, double density) {
    const double speed = std::hypot(along, across);
    if (!(speed > 0)) return 0;
    const double chord = (std::abs(along) * piece.chord_along + std::abs(across) * piece.chord_across) / speed;
    return 0.5 * density * piece.skin * 1.328 * std::sqrt(VISCOSITY * speed / chord);
}

}  // namespace

Mat3 air_resistance(const AirPiece& piece, const Mat3& frame, const Vec3& velocity, double density) {
    const Vec3 local = frame.transpose() * velocity;
    Vec3 diagonal;
    switch (piece.shape) {
        case AirShape::SHEET: {
            const double rub = friction(piece, local[0], local[2], density);
            diagonal = Vec3(rub, pressure(piece, Vec3(0, local[1], 0), density), rub);
            break;
        }
        case AirShape::ROUND: {
            const double push = pressure(piece, Vec3(0, local[1], local[2]), density);
            diagonal = Vec3(friction(piece, local[0], 0, density), push, push);
            break;
        }
        case AirShape::COMPACT: diagonal.setConstant(pressure(piece, local, density)); break;
    }
    return frame * diagonal.asDiagonal() * frame.transpose();
}

}  // namespace frond
