// In: the solid triangles of a frame, uploaded. Out: for each pixel the number of what is seen in its middle, and its
// distance, without anti-aliasing.
#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "gl_objects.hpp"
#include "shaders.hpp"

namespace picture {

namespace {

void make_target(Renderer& renderer) {
    if (renderer.measure_target) return;
    renderer.measure.build(MEASURE_VERTEX, MEASURE_FRAGMENT);
    const auto buffer = [&](GLuint name, GLenum format) {
        glBindRenderbuffer(GL_RENDERBUFFER, name);
        glRenderbufferStorage(GL_RENDERBUFFER, format, renderer.def.width, renderer.def.height);
        return name;
    };
    const GLuint ids = buffer(renderer.ids.make(), GL_R32I), distances = buffer(renderer.distances.make(), GL_R32F),
                 depth = buffer(renderer.measure_depth.make(), GL_DEPTH_COMPONENT32F);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.measure_target.make());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, distances);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        fail("OpenGL cannot draw numbers and distances here; leave frond_picture_set_id away");
}

// OpenGL's rows run upwards.
template <class Value>
void turn_over(std::vector<Value>& values, size_t width) {
    const size_t rows = values.size() / width;
    for (size_t row = 0; row < rows / 2; row++)
        std::swap_ranges(values.begin() + row * width, values.begin() + (row + 1) * width,
                         values.begin() + (rows - 1 - row) * width);
}

}  // namespace

void draw_measures(Renderer& renderer, const Frame& frame, Measures& out) {
    make_target(renderer);
    const size_t count = size_t(renderer.def.width) * size_t(renderer.def.height);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.measure_target);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    const GLint none[4] = {-1, 0, 0, 0};
    const GLfloat far_away[4] = {INFINITY, 0, 0, 0};
    glClearBufferiv(GL_COLOR, 0, none);
    glClearBufferfv(GL_COLOR, 1, far_away);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDepthFunc(GL_LEQUAL);

    const Program& program = renderer.measure;
    program.use();
    glBindVertexArray(renderer.mesh_array);
    glActiveTexture(GL_TEXTURE0);
    for (const MeshRun& run : frame.solid) {
        const bool is_cut = run.texture >= 0 && renderer.textures[size_t(run.texture)].cut;
        glBindTexture(GL_TEXTURE_2D, is_cut ? GLuint(renderer.textures[size_t(run.texture)].name) : renderer.white);
        glUniform1i(program.place("textured"), is_cut);
        glUniform1i(program.place("id"), run.id);
        glDrawElements(GL_TRIANGLES, GLsizei(run.index_count), GL_UNSIGNED_INT,
                       reinterpret_cast<void*>(4 * run.first_index));
    }

    out.ids.resize(count);
    out.distances.resize(count);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, renderer.def.width, renderer.def.height, GL_RED_INTEGER, GL_INT, out.ids.data());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, renderer.def.width, renderer.def.height, GL_RED, GL_FLOAT, out.distances.data());
    turn_over(out.ids, size_t(renderer.def.width));
    turn_over(out.distances, size_t(renderer.def.width));
}

}  // namespace picture
