// Sources of the shaders, GLSL 3.30.
#pragma once

namespace picture {

extern const char* const COMMON_GLSL;  // prepended to each of the others
extern const char* const LIGHT_GLSL;   // prepended to SURFACE_FRAGMENT and GROUND_FRAGMENT
extern const char* const DEPTH_VERTEX;
extern const char* const DEPTH_FRAGMENT;
extern const char* const DEPTH_CUT_FRAGMENT;
extern const char* const SURFACE_VERTEX;
extern const char* const SURFACE_FRAGMENT;
extern const char* const MEASURE_VERTEX;
extern const char* const MEASURE_FRAGMENT;
extern const char* const FULL_VERTEX;
extern const char* const COVER_FRAGMENT;
extern const char* const SHADE_VERTEX;
extern const char* const SHADE_FRAGMENT;
extern const char* const GROUND_VERTEX;
extern const char* const GROUND_FRAGMENT;
extern const char* const BACKGROUND_VERTEX;
extern const char* const BACKGROUND_FRAGMENT;
extern const char* const GLASS_FRAGMENT;
extern const char* const LINE_VERTEX;
extern const char* const POINT_VERTEX;
extern const char* const POINT_FRAGMENT;
extern const char* const FLAT_FRAGMENT;

}  // namespace picture
