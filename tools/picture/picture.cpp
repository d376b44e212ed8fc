// The C functions of a picture: they check input, look up objects, call the renderer and translate errors.
#include "frond_picture.h"

#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>

#include "context.hpp"
#include "error.hpp"
#include "registry.hpp"
#include "renderer.hpp"

using namespace picture;

struct frond_picture {
    frond_picture_def def;
    ContextPointer context;
    RendererPointer renderer;
    std::string description;
    Frame frame;
    bool drawing = false;  // true between begin and end
    std::vector<uint8_t> pixels;
    Measures measures;
    std::map<std::pair<uint64_t, size_t>, int> textures;  // texture indices by hash and length of their bytes
};

namespace {

constexpr uint32_t PICTURE_COOKIE = 0x91c7e01u;

frond_picture& living(const frond_picture* picture) {
    if (!picture) fail("the picture is null; make one with frond_picture_create");
    if (!Registry<frond_picture>::instance().holds(picture))
        fail("the picture has been destroyed, or never was one; make one with frond_picture_create");
    return *const_cast<frond_picture*>(picture);
}

// Returns the frame that is being drawn.
Frame& open_frame(frond_picture* picture) {
    frond_picture& target = living(picture);
    if (!target.drawing) fail("no frame is begun; call frond_picture_begin first");
    return target.frame;
}

Vec checked_point(Vec point, const char* what) {
    if (!drawable(point))
        fail("%s is not finite or too far away; use coordinates up to %g m", what, FROND_PICTURE_FARTHEST);
    return point;
}

double checked_size(double size, double low, double high, const char* what) {
    if (!(size >= low && size <= high)) fail("%s is %g; use %g..%g", what, size, low, high);
    return size;
}

const void* checked_pointer(const void* pointer, const char* what) {
    if (!pointer) fail("%s is null", what);
    return pointer;
}

int checked_count(int count, const char* what) {
    if (count < 0) fail("%s is %d; it cannot be negative", what, count);
    return count;
}

const frond_picture_def& checked_def(const frond_picture_def* def) {
    checked_pointer(def, "the def");
    if (def->cookie != PICTURE_COOKIE) fail("the def was not made by frond_default_picture_def; start from that");
    checked_size(def->width, 1, FROND_PICTURE_LARGEST, "the width");
    checked_size(def->height, 1, FROND_PICTURE_LARGEST, "the height");
    checked_size(def->samples, 1, 16, "the number of samples");
    checked_size(def->shadow_size, 16, 8192, "the shadow map's size");
    checked_size(def->sky_samples, 0, 32, "the number of sky samples");
    // A C caller may have stored any number in the enum.
    int platform = 0;
    static_assert(sizeof platform == sizeof def->platform, "the enum is an int");
    std::memcpy(&platform, &def->platform, sizeof platform);
    if (platform < 0 || platform >= FROND_PICTURE_PLATFORM_COUNT)
        fail("platform %d does not exist; use FROND_PICTURE_ANY", platform);
    return *def;
}

// Computes a variant of FNV-1a over words of eight bytes.
uint64_t hash_of(const uint8_t* bytes, size_t count) {
    uint64_t hash = 14695981039346656037u;
    for (; count >= 8; bytes += 8, count -= 8) {
        uint64_t word;
        std::memcpy(&word, bytes, 8);
        hash = (hash ^ word) * 1099511628211u;
        hash ^= hash >> 29;
    }
    for (; count > 0; bytes++, count--) hash = (hash ^ *bytes) * 1099511628211u;
    return hash;
}

void destroy(frond_picture* picture) {
    // OpenGL objects die with their context; if the host's context is gone, there is nothing to delete.
    try {
        Current current(*picture->context);
        picture->renderer.reset();
    } catch (const std::exception&) {
        picture->renderer.release();
    }
    delete picture;
}

}  // namespace

frond_picture_def frond_default_picture_def(void) {
    frond_picture_def def{};
    def.width = 1280, def.height = 720;
    def.samples = 4;
    def.shadow_size = 2048;
    def.sky_samples = 12;
    const char* wanted = std::getenv("FROND_PICTURE_PLATFORM");
    if (wanted && !std::strcmp(wanted, "surfaceless")) def.platform = FROND_PICTURE_SURFACELESS;
    if (wanted && !std::strcmp(wanted, "device")) def.platform = FROND_PICTURE_DEVICE;
    def.cookie = PICTURE_COOKIE;
    return def;
}

bool frond_picture_create(const frond_picture_def* def, frond_picture** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        checked_pointer(out, "where the picture goes (out)");
        checked_def(def);
        auto made = std::make_unique<frond_picture>();
        made->def = *def;
        made->context = create_context(def->platform);
        {
            Current current(*made->context);
            made->renderer = create_renderer(*def);
            made->description = std::string(platform_name(*made->context)) + ", " + describe(*made->renderer);
        }
        Registry<frond_picture>::instance().add(made.get());
        *out = made.release();
    });
}

void frond_picture_destroy(frond_picture* picture) {
    guarded([&] {
        if (picture && Registry<frond_picture>::instance().remove(picture)) destroy(picture);
    });
}

bool frond_picture_get_size(const frond_picture* picture, int* width, int* height) {
    if (width) *width = 0;
    if (height) *height = 0;
    return guarded([&] {
        const frond_picture& source = living(picture);
        if (width) *width = source.def.width;
        if (height) *height = source.def.height;
    });
}

const char* frond_picture_get_renderer(const frond_picture* picture) {
    const char* text = "";
    guarded([&] { text = living(picture).description.c_str(); });
    return text;
}

bool frond_picture_begin(frond_picture* picture, const frond_picture_scene* scene) {
    return guarded([&] {
        frond_picture& target = living(picture);
        frond_picture_scene checked = checked_scene(scene ? *scene : frond_default_picture_scene());
        target.frame = Frame();
        target.frame.scene = checked;
        target.frame.origin = checked.camera.target;
        target.drawing = true;
    });
}

bool frond_picture_end(frond_picture* picture) {
    return guarded([&] {
        open_frame(picture);
        Current current(*picture->context);
        draw(*picture->renderer, picture->frame, picture->pixels, picture->measures);
        picture->drawing = false;
        picture->frame = Frame();
    });
}

const uint8_t* frond_picture_get_pixels(frond_picture* picture) {
    const uint8_t* pixels = nullptr;
    guarded([&] {
        const frond_picture& source = living(picture);
        if (source.pixels.empty()) fail("no frame has been finished; call frond_picture_end first");
        pixels = source.pixels.data();
    });
    return pixels;
}

bool frond_picture_write(frond_picture* picture, const char* png_path) {
    const uint8_t* pixels = frond_picture_get_pixels(picture);
    return pixels && frond_picture_write_png(png_path, pixels, picture->def.width, picture->def.height);
}

bool frond_picture_set_id(frond_picture* picture, int32_t id) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        frame.id = id;
        frame.is_measured = true;
    });
}

// Returns the measures of the last frame.
static const Measures& measured(const frond_picture* picture) {
    const Measures& measures = living(picture).measures;
    if (measures.ids.empty()) fail("the last frame was not measured; call frond_picture_set_id while it is drawn");
    return measures;
}

const int32_t* frond_picture_get_ids(frond_picture* picture) {
    const int32_t* ids = nullptr;
    guarded([&] { ids = measured(picture).ids.data(); });
    return ids;
}

const float* frond_picture_get_distances(frond_picture* picture) {
    const float* distances = nullptr;
    guarded([&] { distances = measured(picture).distances.data(); });
    return distances;
}

bool frond_picture_present(frond_picture* picture, unsigned framebuffer, int width, int height) {
    return guarded([&] {
        frond_picture& source = living(picture);
        if (source.def.platform != FROND_PICTURE_CURRENT)
            fail("the picture has a context of its own; make it with FROND_PICTURE_CURRENT to show it in yours");
        if (source.pixels.empty()) fail("no frame has been finished; call frond_picture_end first");
        checked_size(width, 1, 65536, "the width");
        checked_size(height, 1, 65536, "the height");
        Current current(*source.context);
        present(*source.renderer, framebuffer, width, height);
    });
}

bool frond_picture_add_texture(frond_picture* picture, const uint8_t* bytes, size_t byte_count, int* out) {
    if (out) *out = -1;
    return guarded([&] {
        frond_picture& target = living(picture);
        checked_pointer(out, "where the texture's index goes (out)");
        checked_pointer(bytes, "the texture's bytes");
        if (byte_count == 0) fail("the texture has no bytes; leave it away");
        const auto key = std::make_pair(hash_of(bytes, byte_count), byte_count);
        const auto known = target.textures.find(key);
        if (known != target.textures.end()) {
            *out = known->second;
            return;
        }
        Image image = decode_image(bytes, byte_count);
        fill_transparent(image);
        Current current(*target.context);
        *out = target.textures[key] = add_texture(*target.renderer, image);
    });
}

bool frond_picture_draw_mesh(frond_picture* picture, const frond_picture_mesh* mesh) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        checked_pointer(mesh, "the mesh");
        checked_count(mesh->vertex_count, "the number of vertices");
        checked_count(mesh->triangle_count, "the number of triangles");
        checked_count(mesh->part_count, "the number of parts");
        if (mesh->vertex_count == 0 || mesh->triangle_count == 0) return;
        checked_pointer(mesh->positions, "the array of positions");
        checked_pointer(mesh->indices, "the array of indices");
        append_mesh(frame, *mesh, texture_count(*picture->renderer));
    });
}

bool frond_picture_draw_sphere(frond_picture* picture, frond_vec3 center, double radius, frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        append_sphere(frame, checked_point(center, "the centre"),
                      checked_size(radius, 0, FROND_PICTURE_FARTHEST, "the radius"),
                      checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_box(frond_picture* picture, frond_vec3 center, frond_quat rotation, frond_vec3 half_extents,
                            frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        const double size = std::sqrt(rotation.x * rotation.x + rotation.y * rotation.y + rotation.z * rotation.z +
                                      rotation.w * rotation.w);
        if (!(size > 1e-6 && size < 1e6)) fail("the rotation is not a quaternion; use (0, 0, 0, 1) for none");
        rotation = {rotation.x / size, rotation.y / size, rotation.z / size, rotation.w / size};
        checked_point(half_extents, "the box's size");
        if (half_extents.x < 0 || half_extents.y < 0 || half_extents.z < 0)
            fail("the box's size is negative; use half its edges");
        append_box(frame, checked_point(center, "the centre"), rotation, half_extents,
                   checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_capsule(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double radius,
                                frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        append_capsule(frame, checked_point(begin, "the capsule's begin"), checked_point(end, "the capsule's end"),
                       checked_size(radius, 0, FROND_PICTURE_FARTHEST, "the radius"),
                       checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_line(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double width,
                             frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        append_line(frame, checked_point(begin, "the line's begin"), checked_point(end, "the line's end"),
                    checked_size(width, 0, 1000, "the width"), checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_arrow(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double width,
                              frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        append_arrow(frame, checked_point(begin, "the arrow's begin"), checked_point(end, "the arrow's end"),
                     checked_size(width, 0, 1000, "the width"), checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_point(frond_picture* picture, frond_vec3 point, double size, frond_color color) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        append_point(frame, checked_point(point, "the point"), checked_size(size, 0, 1000, "the size"),
                     checked_color(color, "the colour"));
    });
}

bool frond_picture_draw_tets(frond_picture* picture, const double* nodes, int node_count, const int32_t* tets,
                             int tet_count, double width, frond_color line, frond_color fill) {
    return guarded([&] {
        Frame& frame = open_frame(picture);
        checked_size(checked_count(node_count, "the number of nodes"), 0, 1e8, "the number of nodes");
        checked_size(checked_count(tet_count, "the number of tets"), 0, 1e8, "the number of tets");
        checked_size(width, 0, 1000, "the width");
        checked_color(line, "the lines' colour");
        checked_color(fill, "the faces' colour");
        if (node_count == 0 || tet_count == 0) return;
        checked_pointer(nodes, "the array of nodes");
        checked_pointer(tets, "the array of tets");
        append_tets(frame, nodes, node_count, tets, tet_count, width, line, fill);
    });
}
