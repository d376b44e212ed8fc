// In: a frame. Out: its pixels. Order: shadows, solid bodies, ground, background, glass and overlays, average, read.
#include <algorithm>
#include <cstring>

#include "error.hpp"
#include "gl_objects.hpp"

namespace picture {

namespace {

template <class Item>
void upload(GLenum target, GLuint buffer, const std::vector<Item>& items) {
    glBindBuffer(target, buffer);
    glBufferData(target, GLsizeiptr(items.size() * sizeof(Item)), items.data(), GL_STREAM_DRAW);
}

void upload_frame(Renderer& renderer, const Frame& frame, const SceneUniforms& scene) {
    glBindBuffer(GL_UNIFORM_BUFFER, renderer.uniforms);
    glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof scene, &scene);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, renderer.uniforms);
    glBindVertexArray(renderer.mesh_array);
    upload(GL_ARRAY_BUFFER, renderer.mesh_vertices, frame.vertices);
    upload(GL_ELEMENT_ARRAY_BUFFER, renderer.mesh_indices, frame.indices);
    upload(GL_ARRAY_BUFFER, renderer.line_vertices, frame.lines);
    upload(GL_ARRAY_BUFFER, renderer.point_vertices, frame.points);
}

void bind_maps(const Renderer& renderer) {
    const auto bind = [](GLuint unit, GLenum target, GLuint texture, GLuint sampler) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(target, texture);
        glBindSampler(unit, sampler);
    };
    bind(1, GL_TEXTURE_2D, renderer.sun_map, renderer.compare);
    bind(2, GL_TEXTURE_2D_ARRAY, renderer.sky_map, renderer.compare);
    bind(4, GL_TEXTURE_2D, renderer.ground_map, renderer.smooth);
    bind(5, GL_TEXTURE_2D, renderer.sun_cover, 0);
    bind(0, GL_TEXTURE_2D, renderer.white, 0);
}

void draw_run(const MeshRun& run) {
    glDrawElements(GL_TRIANGLES, GLsizei(run.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<void*>(4 * run.first_index));
}

void draw_solid(Renderer& renderer, const Frame& frame) {
    const Program& program = renderer.surface;
    program.use();
    glBindVertexArray(renderer.mesh_array);
    glActiveTexture(GL_TEXTURE0);
    for (const MeshRun& run : frame.solid) {
        const bool textured = run.texture >= 0;
        const bool cut = textured && renderer.textures[size_t(run.texture)].cut;
        glBindTexture(GL_TEXTURE_2D, textured ? GLuint(renderer.textures[size_t(run.texture)].name) : renderer.white);
        glUniform4f(program.place("base_color"), run.color.r, run.color.g, run.color.b, run.color.a);
        glUniform1i(program.place("textured"), textured);
        glUniform1f(program.place("translucency"), run.translucency);
        glUniform1f(program.place("gloss"), run.gloss);
        // Cut edges are smoothed: alpha decides how many samples of a pixel are covered.
        (cut && renderer.samples > 1 ? glEnable : glDisable)(GL_SAMPLE_ALPHA_TO_COVERAGE);
        draw_run(run);
    }
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

void draw_ground(Renderer& renderer, const Frame& frame, const SceneUniforms& scene) {
    // The ground is drawn only if seen from above, so that a camera below it sees the plant.
    const Vec up = direction(frame.scene.up, {0, 1, 0});
    const double height = frame.scene.ground_height - dot(up, frame.origin);
    const Vec eye{scene.eye[0], scene.eye[1], scene.eye[2]};
    if (!frame.scene.ground || dot(eye, up) <= height) return;
    const double reach = 1.5 * scene.up[3];
    const Vec side = perpendicular(up), other = cross(up, side);
    std::vector<float> corners;
    for (int corner = 0; corner < 4; corner++) {
        const Vec p = height * up + (corner & 1 ? reach : -reach) * side + (corner & 2 ? reach : -reach) * other;
        for (double value : {p.x, p.y, p.z}) corners.push_back(float(value));
    }
    renderer.ground.use();
    glBindVertexArray(renderer.ground_array);
    upload(GL_ARRAY_BUFFER, renderer.ground_vertices, corners);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void draw_background(Renderer& renderer, const Mat4& inverse_view_projection) {
    renderer.background.use();
    glUniformMatrix4fv(renderer.background.place("inverse_view_projection"), 1, GL_FALSE,
                       inverse_view_projection.data());
    glBindVertexArray(renderer.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Draws overlays twice: first hidden parts, faintly, then those in front.
void draw_overlays(Renderer& renderer, const Frame& frame) {
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (int pass = 0; pass < 2; pass++) {
        glDepthFunc(pass == 0 ? GL_GREATER : GL_LEQUAL);
        glEnable(GL_CULL_FACE);
        renderer.glass.use();
        glBindVertexArray(renderer.mesh_array);
        glUniform1f(renderer.glass.place("faint"), pass == 0 ? 0.4f : 1.0f);
        for (const MeshRun& run : frame.glass) {
            glUniform4f(renderer.glass.place("base_color"), run.color.r, run.color.g, run.color.b, run.color.a);
            draw_run(run);
        }
        glDisable(GL_CULL_FACE);
        if (!frame.lines.empty()) {
            renderer.line.use();
            glUniform1f(renderer.line.place("faint"), pass == 0 ? 0.3f : 1.0f);
            glBindVertexArray(renderer.line_array);
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(frame.lines.size()));
        }
        if (!frame.points.empty()) {
            renderer.point.use();
            glUniform1f(renderer.point.place("faint"), pass == 0 ? 0.45f : 1.0f);
            glBindVertexArray(renderer.point_array);
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(frame.points.size()));
        }
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

void read_pixels(const Renderer& renderer, std::vector<uint8_t>& rgb) {
    const int width = renderer.def.width, height = renderer.def.height;
    std::vector<uint8_t> rgba(size_t(width) * height * 4);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.resolve_target);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    // OpenGL's rows run upwards; the picture's run downwards.
    rgb.resize(size_t(width) * height * 3);
    for (int y = 0; y < height; y++) {
        const uint8_t* from = rgba.data() + size_t(height - 1 - y) * width * 4;
        uint8_t* to = rgb.data() + size_t(y) * width * 3;
        for (int x = 0; x < width; x++) std::memcpy(to + 3 * x, from + 4 * x, 3);
    }
}

// Sets all state that matters, so that the host's settings have no effect.
void set_defaults(const Renderer& renderer) {
    for (GLenum what :
         {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_BLEND, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE,
          GL_POLYGON_OFFSET_FILL, GL_RASTERIZER_DISCARD, GL_COLOR_LOGIC_OP, GL_PRIMITIVE_RESTART, GL_DEPTH_CLAMP})
        glDisable(what);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthRange(0, 1);
    glClearDepth(1);
    glBlendEquation(GL_FUNC_ADD);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (GLuint unit = 0; unit < 6; unit++) glBindSampler(unit, 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, renderer.white);
}

}  // namespace

void draw(Renderer& renderer, const Frame& frame, std::vector<uint8_t>& rgb, Measures& measures) {
    while (glGetError() != GL_NO_ERROR) continue;
    set_defaults(renderer);
    SceneUniforms scene;
    Mat4 inverse_view_projection;
    set_scene(renderer, frame, scene, inverse_view_projection);
    upload_frame(renderer, frame, scene);
    draw_shadows(renderer, frame, scene);

    glBindFramebuffer(GL_FRAMEBUFFER, renderer.target);
    glViewport(0, 0, renderer.def.width, renderer.def.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDepthFunc(GL_LEQUAL);
    bind_maps(renderer);
    draw_solid(renderer, frame);
    draw_ground(renderer, frame, scene);
    draw_background(renderer, inverse_view_projection);
    draw_overlays(renderer, frame);

    // Average the samples of each pixel.
    glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer.target);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, renderer.resolve_target);
    const int width = renderer.def.width, height = renderer.def.height;
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    read_pixels(renderer, rgb);
    measures = {};
    if (frame.is_measured) draw_measures(renderer, frame, measures);

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    for (GLuint unit = 0; unit < 6; unit++) glBindSampler(unit, 0);
    glActiveTexture(GL_TEXTURE0);
    const GLenum error = glGetError();
    if (error == GL_OUT_OF_MEMORY) fail("OpenGL is out of memory; draw less");
    if (error != GL_NO_ERROR) fail("OpenGL error 0x%04x while drawing, please report it", error);
}

void present(Renderer& renderer, unsigned framebuffer, int width, int height) {
    while (glGetError() != GL_NO_ERROR) continue;
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer.resolve_target);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    // A framebuffer without sRGB encoding takes the bytes as they are.
    GLint encoding = GL_LINEAR;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, framebuffer ? GL_COLOR_ATTACHMENT0 : GL_BACK,
                                          GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING, &encoding);
    while (glGetError() != GL_NO_ERROR) continue;
    if (encoding != GL_SRGB) glDisable(GL_FRAMEBUFFER_SRGB);
    glBlitFramebuffer(0, 0, renderer.def.width, renderer.def.height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                      GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (glGetError() != GL_NO_ERROR)
        fail("the framebuffer %u cannot be drawn to; bind one with a colour buffer", framebuffer);
}

}  // namespace picture
