// A single segment, see air_resistance.hpp.
#include "plant/air_resistance.hpp"

namespace frond {

Mat3 air_resistance(const AirPiece& piece, const Mat3& frame, const Vec3& velocity, double density) {
    const Vec3 local = frame.transpose() * velocity;
    const AirLanes<TwoLanes> lanes([&](int) -> const AirPiece& { return piece; });
    const auto both = [](double value) { return constant<TwoLanes>(value); };
    const Lanes3<TwoLanes> diagonal =
        air_resistance<TwoLanes>(lanes, piece.shape, {both(local[0]), both(local[1]), both(local[2])}, density);
    return frame * Vec3(diagonal.x[0], diagonal.y[0], diagonal.z[0]).asDiagonal() * frame.transpose();
}

}  // namespace frond
