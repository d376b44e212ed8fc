// In: the solid triangles of a frame, uploaded. Out: depth seen from the sun and from each direction of the sky, and
// how much of the sky each point of the ground sees.
#include "gl_objects.hpp"

namespace picture {

namespace {

// Maps 0..1 to OpenGL's -1..1.
Mat4 to_clip(const Mat4& matrix) {
    const Mat4 twice = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, -1, -1, -1, 1};
    return multiply(twice, matrix);
}

// Draws the runs that are cut out by their texture's alpha, or those that are not.
void draw_runs(Renderer& renderer, const Frame& frame, bool cut) {
    // Adjacent runs that are not cut out are drawn by one call.
    size_t first = 0, count = 0;
    const auto flush = [&] {
        if (count > 0)
            glDrawElements(GL_TRIANGLES, GLsizei(count), GL_UNSIGNED_INT, reinterpret_cast<void*>(4 * first));
        count = 0;
    };
    for (const MeshRun& run : frame.solid) {
        const bool run_cut = run.texture >= 0 && renderer.textures[size_t(run.texture)].cut;
        if (run_cut != cut || run.is_floor) continue;
        if (cut || first + count != run.first_index) {
            flush();
            first = run.first_index;
        }
        if (cut) glBindTexture(GL_TEXTURE_2D, renderer.textures[size_t(run.texture)].name);
        count += run.index_count;
    }
    flush();
}

void draw_depth(Renderer& renderer, const Frame& frame, const Mat4& matrix, bool any_cut) {
    glClear(GL_DEPTH_BUFFER_BIT);
    const Mat4 clip = to_clip(matrix);
    for (bool cut : {false, true}) {
        if (cut && !any_cut) continue;
        const Program& program = cut ? renderer.depth_cut : renderer.depth;
        program.use();
        glUniformMatrix4fv(program.place("depth_matrix"), 1, GL_FALSE, clip.data());
        draw_runs(renderer, frame, cut);
    }
}

// Draws what is above the ground, as seen from the sun, with means over ever larger squares.
void draw_cover(Renderer& renderer) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.cover_target);
    glViewport(0, 0, renderer.def.shadow_size / 2, renderer.def.shadow_size / 2);
    glDisable(GL_DEPTH_TEST);
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, renderer.sun_map);
    glBindSampler(3, renderer.plain);
    renderer.cover.use();
    glBindVertexArray(renderer.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glActiveTexture(GL_TEXTURE5);
    glBindTexture(GL_TEXTURE_2D, renderer.sun_cover);
    glGenerateMipmap(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
}

// Draws the sky's shade on the ground, from the sky's maps.
void draw_shade(Renderer& renderer, const Frame& frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.shade_target);
    glViewport(0, 0, renderer.shade_size, renderer.shade_size);
    glDisable(GL_DEPTH_TEST);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D_ARRAY, renderer.sky_map);
    glBindSampler(2, renderer.compare);
    renderer.shade.use();
    Mat4 to_map;
    glUniformMatrix4fv(renderer.shade.place("map_to_ground"), 1, GL_FALSE, map_to_ground(frame, to_map).data());
    glBindVertexArray(renderer.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

}  // namespace

void draw_shadows(Renderer& renderer, const Frame& frame, const SceneUniforms& scene) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.shadow_target);
    glBindVertexArray(renderer.mesh_array);
    glActiveTexture(GL_TEXTURE0);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);

    bool any_cut = false;
    for (const Renderer::Texture& texture : renderer.textures) any_cut |= texture.cut;
    glViewport(0, 0, renderer.def.shadow_size, renderer.def.shadow_size);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, renderer.sun_map, 0);
    draw_depth(renderer, frame, scene.sun_matrix, any_cut);

    glViewport(0, 0, renderer.sky_size, renderer.sky_size);
    for (int i = 0; i < renderer.def.sky_samples; i++) {
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, renderer.sky_map, 0, i);
        draw_depth(renderer, frame, scene.sky_matrices[i], any_cut);
    }
    if (!frame.scene.ground) return;
    draw_cover(renderer);
    draw_shade(renderer, frame);
}

}  // namespace picture
