// OpenGL names that delete themselves, and the objects of a renderer.
#pragma once

#include <epoxy/gl.h>

#include <utility>

#include "renderer.hpp"

namespace picture {

enum class Kind { BUFFER, VERTEX_ARRAY, TEXTURE, RENDERBUFFER, FRAMEBUFFER, SAMPLER };

// The name of one object; 0 if there is none.
template <Kind kind>
class Name {
public:
    Name() = default;
    Name(const Name&) = delete;
    Name& operator=(const Name&) = delete;
    Name(Name&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    ~Name() {
        if (!name_) return;
        switch (kind) {
            case Kind::BUFFER:
                glDeleteBuffers(1, &name_);
                break;
            case Kind::VERTEX_ARRAY:
                glDeleteVertexArrays(1, &name_);
                break;
            case Kind::TEXTURE:
                glDeleteTextures(1, &name_);
                break;
            case Kind::RENDERBUFFER:
                glDeleteRenderbuffers(1, &name_);
                break;
            case Kind::FRAMEBUFFER:
                glDeleteFramebuffers(1, &name_);
                break;
            case Kind::SAMPLER:
                glDeleteSamplers(1, &name_);
                break;
        }
    }
    GLuint make() {
        switch (kind) {
            case Kind::BUFFER:
                glGenBuffers(1, &name_);
                break;
            case Kind::VERTEX_ARRAY:
                glGenVertexArrays(1, &name_);
                break;
            case Kind::TEXTURE:
                glGenTextures(1, &name_);
                break;
            case Kind::RENDERBUFFER:
                glGenRenderbuffers(1, &name_);
                break;
            case Kind::FRAMEBUFFER:
                glGenFramebuffers(1, &name_);
                break;
            case Kind::SAMPLER:
                glGenSamplers(1, &name_);
                break;
        }
        return name_;
    }
    operator GLuint() const { return name_; }

private:
    GLuint name_ = 0;
};

// A linked program; its uniforms are looked up by name as they are set.
class Program {
public:
    Program() = default;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program() {
        if (name_) glDeleteProgram(name_);
    }
    // library: functions that the fragment shader uses. Fails with the compiler's message.
    void build(const char* vertex, const char* fragment, const char* library = "");
    void use() const { glUseProgram(name_); }
    GLint place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

private:
    GLuint name_ = 0;
};

// Uniforms of all shaders, laid out as std140: 4-component vectors and matrices only.
struct SceneUniforms {
    Mat4 view_projection, sun_matrix, ground_matrix, sky_matrices[32];
    float sky_directions[32][4];
    float eye[4], up[4], sun_direction[4], sun_color[4], sky_color[4], ground_color[4];
    float ground_plane[4], top_color[4], horizon_color[4];
    float viewport[4];
    int32_t counts[4];
};

struct Renderer {
    frond_picture_def def;
    int samples = 1;  // samples per pixel, as limited by OpenGL
    int sky_size = 512;
    int shade_size = 96;  // size of the map of the sky's light on the ground [pixel]
    Program depth, depth_cut, cover, shade, surface, ground, background, glass, line, point, measure;
    Name<Kind::BUFFER> uniforms, mesh_vertices, mesh_indices, ground_vertices, line_vertices, point_vertices;
    Name<Kind::VERTEX_ARRAY> mesh_array, ground_array, empty_array, line_array, point_array;
    Name<Kind::TEXTURE> sun_map, sun_cover, sky_map, ground_map, white;
    Name<Kind::SAMPLER> compare, plain, smooth;
    Name<Kind::RENDERBUFFER> color, depth_buffer, resolved, ids, distances, measure_depth;
    Name<Kind::FRAMEBUFFER> target, resolve_target, shadow_target, cover_target, shade_target;
    Name<Kind::FRAMEBUFFER> measure_target;  // made for the first frame that is measured
    struct Texture {
        Name<Kind::TEXTURE> name;
        bool cut = false;  // parts of it are transparent
    };
    std::vector<Texture> textures;
};

// Fills in the uniforms of a frame: camera, light, and one matrix for each direction from which light comes. The near
// and far planes enclose the whole frame.
void set_scene(const Renderer& renderer, const Frame& frame, SceneUniforms& scene, Mat4& inverse_view_projection);
// Returns the matrix from the ground's map to the ground, the inverse of to_map.
Mat4 map_to_ground(const Frame& frame, Mat4& to_map);
// Draws depth maps of sun and sky, and from them the sky's shade on the ground. Leaves a framebuffer of its own bound.
void draw_shadows(Renderer& renderer, const Frame& frame, const SceneUniforms& scene);
// Draws numbers and distances of the uploaded surfaces and reads them. Leaves a framebuffer of its own bound.
void draw_measures(Renderer& renderer, const Frame& frame, Measures& out);

}  // namespace picture
