// Materials with the required properties only: solid, isotropic, elastic.
#pragma once

#include "frond/frond.h"

inline frond_material plain_material(double density, double young, double poisson, double thickness) {
    frond_material material = {};
    material.density = density;
    material.young = young;
    material.poisson = poisson;
    material.thickness = thickness;
    return material;
}
