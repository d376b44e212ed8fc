// Light: a sun with a soft shadow map, and a sky sampled in several directions, each with a small shadow map of its
// own, so that enclosed places are darker. Leaves let some light through. Tone curve: Reinhard, Stark, Shirley,
// Ferwerda, "Photographic tone reproduction for digital images" (2002), equation 4.
#include "shaders.hpp"

namespace picture {

const char* const COMMON_GLSL = R"(#version 330 core
layout(std140) uniform Scene {
    mat4 view_projection;
    mat4 sun_matrix;         // to the shadow map's 0..1
    mat4 ground_matrix;      // to the 0..1 of the map of what the sky gives to the ground
    mat4 sky_matrices[32];
    vec4 sky_directions[32];
    vec4 eye;                // w: distance at which the ground begins to fade
    vec4 up;                 // w: distance at which the ground has faded
    vec4 sun_direction;      // w: size of the sun map's texel [m]
    vec4 sun_color;          // w: exposure
    vec4 sky_color;          // w: size of a sky map's texel [m]
    vec4 ground_color;       // w: depth range of the sun map [m]
    vec4 ground_plane;       // z of the ground in the sun map: x u + y v + z
    vec4 top_color;
    vec4 horizon_color;
    vec4 viewport;           // width, height; z: width of the sun map [m]; w: distance from the eye to the target
    ivec4 counts;            // directions of the sky; whether there is multisampling; whether there is ground
};
)"
                                R"(
// What is seen in a direction where nothing is.
vec3 background(vec3 direction) {
    float height = dot(direction, up.xyz);
    return mix(horizon_color.rgb, top_color.rgb, smoothstep(-0.02, 0.6, height));
}
)";

const char* const LIGHT_GLSL = R"(
uniform sampler2DShadow sun_map;
uniform sampler2DArrayShadow sky_map;

// Share of the sun that arrives, averaged over a disc of the map.
float sun_visible(vec3 at, float radius) {
    vec4 place = sun_matrix * vec4(at, 1.0);
    if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
    float depth = min(place.z, 1.0);
    float sum = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) sum += texture(sun_map, vec3(place.xy + radius * vec2(x, y), depth));
    return sum / 9.0;
}
float sky_visible(vec3 at, int i) {
    vec4 place = sky_matrices[i] * vec4(at, 1.0);
    if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
    return texture(sky_map, vec4(place.xy, float(i), min(place.z, 1.0)));
}
)";

const char* const DEPTH_VERTEX = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
uniform mat4 depth_matrix;
out vec2 surface_uv;
void main() {
    surface_uv = uv;
    gl_Position = depth_matrix * vec4(position, 1.0);
}
)";

const char* const DEPTH_FRAGMENT = R"(
void main() {}
)";

const char* const DEPTH_CUT_FRAGMENT = R"(
uniform sampler2D base_texture;
in vec2 surface_uv;
void main() {
    if (texture(base_texture, surface_uv).a < 0.5) discard;
}
)";

// The fourth clip coordinate of a camera with perspective is the distance along its axis.
const char* const MEASURE_VERTEX = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
out vec2 surface_uv;
out float surface_distance;
void main() {
    surface_uv = uv;
    gl_Position = view_projection * vec4(position, 1.0);
    surface_distance = gl_Position.w;
}
)";

const char* const MEASURE_FRAGMENT = R"(
uniform sampler2D base_texture;
uniform bool textured;
uniform int id;
in vec2 surface_uv;
in float surface_distance;
layout(location = 0) out int seen_id;
layout(location = 1) out float seen_distance;
void main() {
    if (textured && texture(base_texture, surface_uv).a < 0.5) discard;
    seen_id = id;
    seen_distance = surface_distance;
}
)";

const char* const SURFACE_VERTEX = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
out vec3 surface_position;
out vec3 surface_normal;
out vec2 surface_uv;
out vec3 surface_color;
void main() {
    surface_position = position;
    surface_normal = normal;
    surface_uv = uv;
    surface_color = mix(color.rgb / 12.92, pow((color.rgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, color.rgb));
    gl_Position = view_projection * vec4(position, 1.0);
}
)";

const char* const SURFACE_FRAGMENT = R"(
uniform sampler2D base_texture;
uniform bool textured;
uniform vec4 base_color;
uniform float translucency;
uniform float gloss;
in vec3 surface_position;
in vec3 surface_normal;
in vec2 surface_uv;
in vec3 surface_color;
out vec4 pixel;

void main() {
    // Colour, and a cut as sharp as the picture allows: coverage follows alpha over one pixel.
    vec4 base = base_color;
    float coverage = 1.0;
    if (textured) {
        vec4 texel = texture(base_texture, surface_uv);
        base.rgb *= texel.rgb;
        coverage = clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0);
        if (coverage < (counts.y != 0 ? 0.01 : 0.5)) discard;
    }
    vec3 albedo = clamp(base.rgb * surface_color, 0.0, 1.0);

    // The normal on the side that is looked at, whichever way the sheet was modelled.
    vec3 to_eye = normalize(eye.xyz - surface_position);
    vec3 face = cross(dFdx(surface_position), dFdy(surface_position));
    float face_size = length(face);
    face = face_size > 0.0 ? face / face_size : to_eye;
    if (dot(face, to_eye) < 0.0) face = -face;
    float normal_size = length(surface_normal);
    vec3 normal = normal_size > 0.1 ? surface_normal / normal_size : face;
    if (dot(normal, face) < 0.0) normal = -normal;

    // Sun: from the front, round a leaf's edge into its shade, and from behind through the leaf.
    float sun_dot = dot(normal, sun_direction.xyz);
    float wrap = 0.15 * min(4.0 * translucency, 1.0);
    float front = max((sun_dot + wrap) / (1.0 + wrap), 0.0);
    float behind = max(-sun_dot * 0.9 + 0.1, 0.0) * translucency;
    vec3 lifted = surface_position + (dot(face, sun_direction.xyz) >= 0.0 ? face : -face) * sun_direction.w * 1.5 +
                  sun_direction.xyz * sun_direction.w;
    float sun_share = front + behind > 0.0 ? sun_visible(lifted, sun_direction.w * 1.3 / viewport.z) : 0.0;
    // Light that went through a leaf is more yellow and more saturated.
    vec3 through = albedo * (0.5 + 1.6 * albedo / max(max(albedo.r, max(albedo.g, albedo.b)), 1e-3));
    vec3 light = sun_color.rgb * sun_share * albedo * front;
    light += sun_color.rgb * sun_share * through * behind;

    // Sky, and light thrown back by the ground.
    vec3 sky = vec3(0.0);
    float open = 1.0;
    float sky_front = 0.0, sky_behind = 0.0;
    if (counts.x > 0) {
        open = 0.0;
        for (int i = 0; i < counts.x; i++) {
            vec3 toward = sky_directions[i].xyz;
            float visible = sky_visible(surface_position + toward * sky_color.w * 1.2, i);
            float cosine = dot(normal, toward);
            sky_front += visible * max(cosine, 0.0);
            sky_behind += visible * max(-cosine, 0.0);
            open += visible;
        }
        sky_front *= 2.0 / float(counts.x);
        sky_behind *= 2.0 / float(counts.x);
        open /= float(counts.x);
    } else {
        sky_front = 0.5 + 0.5 * dot(normal, up.xyz);
        sky_behind = 0.5 - 0.5 * dot(normal, up.xyz);
    }
    vec3 bounce = 0.35 * (sky_color.rgb + 0.5 * sun_color.rgb) * vec3(0.62, 0.58, 0.5);
    float below = 0.5 - 0.5 * dot(normal, up.xyz);
    light += albedo * (sky_color.rgb * sky_front + bounce * below * (0.25 + 0.75 * open));
    light += through * translucency * sky_color.rgb * sky_behind;
    light += albedo * sky_color.rgb * 0.06;

    // A waxy sheen: Blinn's half vector, stronger at grazing angles.
    vec3 half_way = normalize(to_eye + sun_direction.xyz);
    float grazing = pow(1.0 - max(dot(normal, to_eye), 0.0), 5.0);
    float sharp = mix(12.0, 70.0, gloss);
    float sheen = pow(max(dot(normal, half_way), 0.0), sharp) * (sharp + 8.0) / 25.0;
    light += gloss * 0.12 * sheen * sun_share * step(0.0, sun_dot) * sun_color.rgb;
    light += gloss * (0.03 + 0.25 * grazing) * open * sky_color.rgb * 0.7;

    light *= sun_color.w;
    pixel = vec4(light * (1.0 + light / 12.0) / (1.0 + 0.85 * light), coverage);
}
)";

const char* const FULL_VERTEX = R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// Writes where in the sun's map something is above the ground, and its distance from it along the light.
const char* const COVER_FRAGMENT = R"(
uniform sampler2D sun_depth;
out vec4 pixel;
void main() {
    ivec2 first = 2 * ivec2(gl_FragCoord.xy);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 2; i++) {
        ivec2 texel = first + i;
        float depth = texelFetch(sun_depth, texel, 0).r;
        vec2 place = (vec2(texel) + 0.5) / float(textureSize(sun_depth, 0).x);
        float gap = dot(ground_plane.xy, place) + ground_plane.z - depth;
        if (depth < 1.0 && gap > 0.0) sum += vec2(1.0, gap * ground_color.w);
    }
    pixel = vec4(sum / 2.0, 0.0, 1.0);
}
)";

const char* const SHADE_VERTEX = R"(
uniform mat4 map_to_ground;
out vec3 at;
out vec3 step_u;
out vec3 step_v;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    at = (map_to_ground * vec4(0.5 + 0.5 * corner, 0.0, 1.0)).xyz;
    step_u = map_to_ground[0].xyz;
    step_v = map_to_ground[1].xyz;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// Writes the sky's light on the ground, coarsely, as it changes slowly: each direction is smeared over some points.
const char* const SHADE_FRAGMENT = R"(
in vec3 at;
in vec3 step_u;
in vec3 step_v;
out vec4 pixel;
void main() {
    float seen = 0.0, possible = 0.0;
    for (int i = 0; i < counts.x; i++) {
        float cosine = dot(sky_directions[i].xyz, up.xyz);
        for (int k = 0; k < 5; k++) {
            vec2 shift = 0.022 * sqrt((float(k) + 0.5) / 5.0) * vec2(cos(float(k) * 2.399963), sin(float(k) * 2.399963));
            seen += cosine * sky_visible(at + shift.x * step_u + shift.y * step_v, i);
        }
        possible += 5.0 * cosine;
    }
    pixel = vec4(possible > 0.0 ? seen / possible : 1.0);
}
)";

const char* const GROUND_VERTEX = R"(
layout(location = 0) in vec3 position;
out vec3 surface_position;
void main() {
    surface_position = position;
    gl_Position = view_projection * vec4(position, 1.0);
}
)";

const char* const GROUND_FRAGMENT = R"(
uniform sampler2D ground_map;
uniform sampler2D sun_cover;
in vec3 surface_position;
out vec4 pixel;

// The shadow is sharp where it begins and wider the farther its cause: Fernando, "Percentage-closer soft shadows" (2005).
// Whatever is above the plane throws a shadow on it, so that means from a pyramid serve and nothing is compared.
float soft_sun(vec3 at) {
    vec2 place = (sun_matrix * vec4(at, 1.0)).xy;
    if (any(lessThan(place, vec2(-0.05))) || any(greaterThan(place, vec2(1.05)))) return 1.0;
    float size = float(textureSize(sun_cover, 0).x), sun_size = 0.04;
    float widest = sun_size * ground_color.w / viewport.z;
    float level = log2(max(0.5 * widest * size, 1.0));
    vec2 mean = vec2(1e-5, 0.0);
    for (int i = 0; i < 4; i++) {
        vec2 shift = 0.5 * widest * vec2((i & 1) == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
        mean += textureLod(sun_cover, place + shift, level).rg;
    }
    if (mean.x < 2e-4) return 1.0;
    float radius = clamp(sun_size * mean.y / mean.x / viewport.z, 1.2 / size, widest);
    level = log2(max(0.5 * radius * size, 1.0));
    float covered = 0.0;
    for (int i = 0; i < 10; i++) {
        float r = sqrt((float(i) + 0.5) / 10.0), a = float(i) * 2.399963;
        covered += textureLod(sun_cover, place + radius * r * vec2(cos(a), sin(a)), level).r;
    }
    return 1.0 - covered / 10.0;
}

void main() {
    vec3 direction = normalize(surface_position - eye.xyz);
    float away = length(surface_position);
    float fade = smoothstep(eye.w, up.w, away);

    // Only the share of light that is missing matters: far from the plant the ground has exactly its own colour.
    float sun_height = max(dot(sun_direction.xyz, up.xyz), 0.0);
    vec3 all = sun_color.rgb * sun_height + sky_color.rgb + 1e-4;
    float sun_share = soft_sun(surface_position);
    vec2 place = (ground_matrix * vec4(surface_position, 1.0)).xy;
    vec2 inside = smoothstep(vec2(0.0), vec2(0.12), min(place, 1.0 - place));
    float sky_share = mix(1.0, texture(ground_map, place).r, inside.x * inside.y);
    vec3 share = (sun_color.rgb * sun_height * sun_share + sky_color.rgb * sky_share) / all;
    vec3 ground = ground_color.rgb * mix(vec3(1.0), share, 0.92);
    pixel = vec4(mix(ground, background(direction), fade), 1.0);
}
)";

const char* const BACKGROUND_VERTEX = R"(
uniform mat4 inverse_view_projection;
out vec3 far_point;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 point = inverse_view_projection * vec4(corner, 1.0, 1.0);
    far_point = point.xyz / point.w;
    gl_Position = vec4(corner, 1.0, 1.0);
}
)";

const char* const BACKGROUND_FRAGMENT = R"(
in vec3 far_point;
out vec4 pixel;
void main() { pixel = vec4(background(normalize(far_point - eye.xyz)), 1.0); }
)";

const char* const GLASS_FRAGMENT = R"(
uniform vec4 base_color;
uniform float faint;
in vec3 surface_position;
in vec3 surface_normal;
in vec2 surface_uv;
in vec3 surface_color;
out vec4 pixel;
void main() {
    vec3 to_eye = normalize(eye.xyz - surface_position);
    float facing = abs(dot(normalize(surface_normal), to_eye));
    vec3 color = base_color.rgb * surface_color * (0.7 + 0.3 * max(dot(normalize(surface_normal), sun_direction.xyz), 0.0));
    pixel = vec4(color, clamp(base_color.a * (0.75 + 1.1 * pow(1.0 - facing, 3.0)), 0.0, 1.0) * faint);
}
)";

const char* const LINE_VERTEX = R"(
layout(location = 0) in vec4 begin;
layout(location = 1) in vec4 end;
layout(location = 2) in vec2 offset;
layout(location = 3) in vec4 color;
uniform float faint;
out vec4 flat_color;
void main() {
    // Cut what is behind the eye, then work in pixels.
    vec4 a = view_projection * vec4(begin.xyz, 1.0), b = view_projection * vec4(end.xyz, 1.0);
    float near = 1e-3 * viewport.w;
    flat_color = vec4(color.rgb, color.a * faint);
    if (a.w < near && b.w < near) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
    if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
    vec2 half_size = 0.5 * viewport.xy;
    vec2 from = a.xy / a.w * half_size, to = b.xy / b.w * half_size;
    float size = length(to - from);
    vec2 along = size > 1e-3 ? (to - from) / size : vec2(1.0, 0.0);
    // An offset below zero counts from the end of the line.
    float first = offset.x < 0.0 ? max(size + offset.x, 0.0) : 0.0;
    float last = max(size + offset.y, 0.0);
    bool at_end = gl_VertexID >= 2;
    float place = at_end ? last : first;
    float width = max(at_end ? end.w : begin.w, 0.0);
    float side = (gl_VertexID & 1) == 0 ? -0.5 : 0.5;
    vec2 pixel = from + along * place + vec2(-along.y, along.x) * width * side;
    float share = size > 1e-3 ? place / size : 0.0;
    float depth = mix(a.z / a.w, b.z / b.w, share);
    gl_Position = vec4(pixel / half_size, depth - 2e-5, 1.0);
}
)";

const char* const POINT_VERTEX = R"(
layout(location = 0) in vec4 position;
layout(location = 3) in vec4 color;
uniform float faint;
out vec4 flat_color;
out vec2 place;
out float radius;
void main() {
    vec4 middle = view_projection * vec4(position.xyz, 1.0);
    flat_color = vec4(color.rgb, color.a * faint);
    radius = 0.5 * position.w + 0.5;
    place = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0) * radius;
    gl_Position = middle.w < 1e-3 * viewport.w
                      ? vec4(2.0, 2.0, 2.0, 1.0)
                      : vec4(middle.xy / middle.w + place / (0.5 * viewport.xy), middle.z / middle.w - 2e-5, 1.0);
}
)";

const char* const POINT_FRAGMENT = R"(
in vec4 flat_color;
in vec2 place;
in float radius;
out vec4 pixel;
void main() {
    float inside = clamp(radius - length(place), 0.0, 1.0);
    float rim = clamp(length(place) - (radius - 2.0), 0.0, 1.0);
    if (inside <= 0.0) discard;
    pixel = vec4(flat_color.rgb * (1.0 - 0.6 * rim), flat_color.a * inside);
}
)";

const char* const FLAT_FRAGMENT = R"(
in vec4 flat_color;
out vec4 pixel;
void main() { pixel = flat_color; }
)";

}  // namespace picture
