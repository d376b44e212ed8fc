// In: size and quality. Out: programs, render targets and buffers in the current context.
#include <algorithm>
#include <cstddef>
#include <cstdio>

#include "error.hpp"
#include "gl_objects.hpp"
#include "shaders.hpp"

namespace picture {

namespace {

GLuint compile(GLenum kind, const char* library, const char* text) {
    const GLuint shader = glCreateShader(kind);
    const char* const parts[] = {COMMON_GLSL, library, text};
    glShaderSource(shader, 3, parts, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    char log[700] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    fail("the OpenGL driver does not compile a shader, please report it with the driver's name: %s", log);
}

void make_map(GLenum target, GLuint texture, int size, int layers) {
    glBindTexture(target, texture);
    if (target == GL_TEXTURE_2D)
        glTexImage2D(target, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    else
        glTexImage3D(target, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

void check_target(const char* what) {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        fail("OpenGL cannot make the %s (status 0x%04x); make the picture smaller or use fewer samples", what, status);
}

void attribute(GLuint index, GLint count, GLenum type, bool normalized, size_t stride, size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, count, type, normalized, GLsizei(stride), reinterpret_cast<void*>(offset));
}

void make_arrays(Renderer& renderer) {
    glBindVertexArray(renderer.mesh_array.make());
    glBindBuffer(GL_ARRAY_BUFFER, renderer.mesh_vertices.make());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, renderer.mesh_indices.make());
    attribute(0, 3, GL_FLOAT, false, sizeof(MeshVertex), offsetof(MeshVertex, position));
    attribute(1, 3, GL_FLOAT, false, sizeof(MeshVertex), offsetof(MeshVertex, normal));
    attribute(2, 2, GL_FLOAT, false, sizeof(MeshVertex), offsetof(MeshVertex, uv));
    attribute(3, 4, GL_UNSIGNED_BYTE, true, sizeof(MeshVertex), offsetof(MeshVertex, color));

    glBindVertexArray(renderer.ground_array.make());
    glBindBuffer(GL_ARRAY_BUFFER, renderer.ground_vertices.make());
    attribute(0, 3, GL_FLOAT, false, 3 * sizeof(float), 0);

    // One instance per line and per point; the shader makes the four corners.
    glBindVertexArray(renderer.line_array.make());
    glBindBuffer(GL_ARRAY_BUFFER, renderer.line_vertices.make());
    attribute(0, 4, GL_FLOAT, false, sizeof(LineVertex), offsetof(LineVertex, begin));
    attribute(1, 4, GL_FLOAT, false, sizeof(LineVertex), offsetof(LineVertex, end));
    attribute(2, 2, GL_FLOAT, false, sizeof(LineVertex), offsetof(LineVertex, offset));
    attribute(3, 4, GL_FLOAT, false, sizeof(LineVertex), offsetof(LineVertex, color));
    for (GLuint index = 0; index < 4; index++) glVertexAttribDivisor(index, 1);

    glBindVertexArray(renderer.point_array.make());
    glBindBuffer(GL_ARRAY_BUFFER, renderer.point_vertices.make());
    attribute(0, 4, GL_FLOAT, false, sizeof(PointVertex), offsetof(PointVertex, position));
    attribute(3, 4, GL_FLOAT, false, sizeof(PointVertex), offsetof(PointVertex, color));
    glVertexAttribDivisor(0, 1);
    glVertexAttribDivisor(3, 1);

    renderer.empty_array.make();
    glBindVertexArray(0);
}

void make_targets(Renderer& renderer) {
    const frond_picture_def& def = renderer.def;
    // A multisampled target, and the target into which it is averaged.
    glBindRenderbuffer(GL_RENDERBUFFER, renderer.color.make());
    const GLsizei samples = renderer.samples > 1 ? renderer.samples : 0;
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_SRGB8_ALPHA8, def.width, def.height);
    glBindRenderbuffer(GL_RENDERBUFFER, renderer.depth_buffer.make());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, def.width, def.height);
    glBindRenderbuffer(GL_RENDERBUFFER, renderer.resolved.make());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, def.width, def.height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);

    glBindFramebuffer(GL_FRAMEBUFFER, renderer.target.make());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderer.color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderer.depth_buffer);
    check_target("picture");
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.resolve_target.make());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderer.resolved);
    check_target("picture");

    // Depth maps, seen from the sun and from directions of the sky.
    make_map(GL_TEXTURE_2D, renderer.sun_map.make(), def.shadow_size, 1);
    make_map(GL_TEXTURE_2D_ARRAY, renderer.sky_map.make(), renderer.sky_size, std::max(def.sky_samples, 1));
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.shadow_target.make());
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, renderer.sun_map, 0);
    check_target("shadow map");
    const int cover_size = def.shadow_size / 2;
    glBindTexture(GL_TEXTURE_2D, renderer.sun_cover.make());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG16F, cover_size, cover_size, 0, GL_RG, GL_HALF_FLOAT, nullptr);
    glGenerateMipmap(GL_TEXTURE_2D);
    const float nothing[4] = {0, 0, 0, 0};
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, nothing);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.cover_target.make());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, renderer.sun_cover, 0);
    check_target("shadow map");
    glBindTexture(GL_TEXTURE_2D, renderer.ground_map.make());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R16, renderer.shade_size, renderer.shade_size, 0, GL_RED, GL_UNSIGNED_SHORT,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer.shade_target.make());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, renderer.ground_map, 0);
    check_target("shade map");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void make_samplers(Renderer& renderer) {
    const auto set = [](GLuint sampler, GLint filter, GLint mode) {
        glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, filter);
        glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, filter);
        glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, mode);
        glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    };
    set(renderer.compare.make(), GL_LINEAR, GL_COMPARE_REF_TO_TEXTURE);
    set(renderer.plain.make(), GL_NEAREST, GL_NONE);
    set(renderer.smooth.make(), GL_LINEAR, GL_NONE);
}

}  // namespace

void Program::build(const char* vertex, const char* fragment, const char* library) {
    const GLuint first = compile(GL_VERTEX_SHADER, "", vertex), second = compile(GL_FRAGMENT_SHADER, library, fragment);
    name_ = glCreateProgram();
    glAttachShader(name_, first);
    glAttachShader(name_, second);
    glLinkProgram(name_);
    glDeleteShader(first);
    glDeleteShader(second);
    GLint ok = 0;
    glGetProgramiv(name_, GL_LINK_STATUS, &ok);
    char log[700] = "";
    glGetProgramInfoLog(name_, sizeof log, nullptr, log);
    if (!ok) fail("the OpenGL driver does not link a shader, please report it with the driver's name: %s", log);
    const GLuint block = glGetUniformBlockIndex(name_, "Scene");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(name_, block, 0);

    // Texture units are the same in all programs.
    glUseProgram(name_);
    const char* const units[] = {"base_texture", "sun_map", "sky_map", "sun_depth", "ground_map", "sun_cover"};
    for (int unit = 0; unit < 6; unit++)
        if (place(units[unit]) >= 0) glUniform1i(place(units[unit]), unit);
    glUseProgram(0);
}

RendererPointer create_renderer(const frond_picture_def& def) {
    if (epoxy_gl_version() < 33 || !epoxy_is_desktop_gl())
        fail("OpenGL %d.%d is too old; 3.3 is needed", epoxy_gl_version() / 10, epoxy_gl_version() % 10);
    RendererPointer renderer(new Renderer);
    renderer->def = def;
    GLint most_samples = 1, largest = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    renderer->samples = std::min(def.samples, std::max(most_samples, 1));
    if (largest < def.width || largest < def.height)
        fail("OpenGL draws at most %d pixels in a row here; make the picture smaller", largest);
    renderer->sky_size = std::clamp(def.shadow_size / 4, 16, 1024);

    while (glGetError() != GL_NO_ERROR) continue;
    renderer->depth.build(DEPTH_VERTEX, DEPTH_FRAGMENT);
    renderer->depth_cut.build(DEPTH_VERTEX, DEPTH_CUT_FRAGMENT);
    renderer->cover.build(FULL_VERTEX, COVER_FRAGMENT);
    renderer->shade.build(SHADE_VERTEX, SHADE_FRAGMENT, LIGHT_GLSL);
    renderer->surface.build(SURFACE_VERTEX, SURFACE_FRAGMENT, LIGHT_GLSL);
    renderer->ground.build(GROUND_VERTEX, GROUND_FRAGMENT, LIGHT_GLSL);
    renderer->background.build(BACKGROUND_VERTEX, BACKGROUND_FRAGMENT, LIGHT_GLSL);
    renderer->glass.build(SURFACE_VERTEX, GLASS_FRAGMENT);
    renderer->line.build(LINE_VERTEX, FLAT_FRAGMENT);
    renderer->point.build(POINT_VERTEX, POINT_FRAGMENT);
    make_arrays(*renderer);
    make_targets(*renderer);
    make_samplers(*renderer);
    glBindBuffer(GL_UNIFORM_BUFFER, renderer->uniforms.make());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(SceneUniforms), nullptr, GL_DYNAMIC_DRAW);
    // Bound while a run without a texture is drawn.
    const uint8_t white[4] = {255, 255, 255, 255};
    glBindTexture(GL_TEXTURE_2D, renderer->white.make());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    const GLenum error = glGetError();
    if (error == GL_OUT_OF_MEMORY) fail("OpenGL is out of memory; make the picture or the shadow map smaller");
    if (error != GL_NO_ERROR) fail("OpenGL error 0x%04x while getting ready, please report it", error);
    return renderer;
}

void RendererDeleter::operator()(Renderer* renderer) const noexcept {
    delete renderer;
}

std::string describe(const Renderer&) {
    const auto text = [](GLenum name) {
        const GLubyte* string = glGetString(name);
        return std::string(string ? reinterpret_cast<const char*>(string) : "?");
    };
    return "OpenGL " + text(GL_VERSION) + ", " + text(GL_RENDERER);
}

int texture_count(const Renderer& renderer) {
    return int(renderer.textures.size());
}

int add_texture(Renderer& renderer, const Image& image) {
    Renderer::Texture texture;
    for (size_t i = 3; i < image.rgba.size() && !texture.cut; i += 4) texture.cut = image.rgba[i] < 128;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (image.width > largest || image.height > largest)
        fail("the texture is %d x %d pixels, OpenGL takes %d here; make it smaller", image.width, image.height,
             largest);
    while (glGetError() != GL_NO_ERROR) continue;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.name.make());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, 0);
    if (glGetError() != GL_NO_ERROR) fail("OpenGL has no memory for the texture; make it smaller");
    renderer.textures.push_back(std::move(texture));
    return int(renderer.textures.size()) - 1;
}

}  // namespace picture
