/* frond_picture.h - pictures of plants, drawn without a display. Compiles as C99 and as C++.
 *
 * A picture is a canvas with an OpenGL context of its own (EGL: no window system, no GPU needed). A frame is begun with
 * a camera and light, filled by draw calls in any order, and ended; then its pixels can be read, written or compared.
 *
 * Units      metre, radian; pixel for the width of lines and the size of points.
 * Colours    linear RGBA in 0..1 where a frond_color is taken; vertex colours, textures and pixels are sRGB bytes.
 * Pixels     RGB, 3 bytes per pixel, rows from top to bottom without padding.
 * Errors     Functions that can fail return false; frond_picture_last_error() then gives cause and remedy, and out
 *            parameters are zeroed. Wrong input never aborts the program. Triangles whose vertices are not finite,
 *            do not exist or are farther than FROND_PICTURE_FARTHEST from the origin are left out.
 * Threads    Different pictures may be used from different threads, one picture by one thread at a time.
 * Sameness   The same calls give the same pixels on the same machine.
 */
#ifndef FROND_PICTURE_H
#define FROND_PICTURE_H

/* The types of the library frond; only the drawing of plants, bodies and robots links to it. */
#include "frond/frond.h"
#include "frond/frond_robot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FROND_PICTURE_LARGEST 8192   /* width and height of a picture [pixel] */
#define FROND_PICTURE_FARTHEST 1.0e6 /* largest coordinate that is drawn [m] */

typedef struct frond_color {
    float r, g, b, a;
} frond_color;

/* Returns the text of this thread's last failed call. Never null; "" if none failed yet. */
const char* frond_picture_last_error(void);

/* ---- picture ------------------------------------------------------------------------------------------- */

/* Origin of the OpenGL context. */
typedef enum frond_picture_platform {
    FROND_PICTURE_ANY,         /* surfaceless; if that fails, each device in turn */
    FROND_PICTURE_SURFACELESS, /* EGL_MESA_platform_surfaceless */
    FROND_PICTURE_DEVICE,      /* EGL_EXT_platform_device, the first device that works */
    FROND_PICTURE_CURRENT,     /* the caller's own context, which must be current at every call on the picture */
    FROND_PICTURE_PLATFORM_COUNT
} frond_picture_platform;

typedef struct frond_picture_def {
    int width, height; /* 1..FROND_PICTURE_LARGEST, default 1280 x 720 */
    int samples;       /* of anti-aliasing, 1..16, default 4; fewer if OpenGL supports fewer */
    int shadow_size;   /* size of the sun's shadow map [pixel], 16..8192, default 2048 */
    int sky_samples;   /* directions sampled for the sky's light, 0..32, default 12; 0 is fastest: no soft shade */
    frond_picture_platform platform; /* default FROND_PICTURE_ANY; the environment variable FROND_PICTURE_PLATFORM
                                      * (surfaceless or device) overrides the default */
    uint32_t cookie;                 /* do not set */
} frond_picture_def;

typedef struct frond_picture frond_picture;

frond_picture_def frond_default_picture_def(void);
bool frond_picture_create(const frond_picture_def* def, frond_picture** out);
/* Ignores null and destroyed pictures. */
void frond_picture_destroy(frond_picture* picture);
bool frond_picture_get_size(const frond_picture* picture, int* width, int* height);
/* "surfaceless, OpenGL 4.5 ..., llvmpipe ..."; "" for a null or destroyed picture. Lives as long as the picture. */
const char* frond_picture_get_renderer(const frond_picture* picture);

/* ---- scene: camera and light of one frame ---------------------------------------------------------------- */

typedef struct frond_picture_camera {
    frond_vec3 eye, target;
    frond_vec3 up;        /* default (0, 1, 0) */
    double field_of_view; /* vertical, 0.01..3, default 0.6 */
} frond_picture_camera;

typedef struct frond_picture_scene {
    frond_picture_camera camera;
    frond_vec3 sun_direction; /* towards the sun; (0,0,0) (default): over the camera's left shoulder, somewhat behind
                               * its target, so that leaves glow */
    frond_color sun;          /* light of the sun, default (2.75, 2.6, 2.3) */
    frond_color sky;          /* light of the sky, default (0.78, 0.86, 0.98) */
    double exposure;          /* factor, 0..100, default 1 */
    frond_color background_top, background_horizon; /* as displayed on the screen */
    bool ground;                                    /* default true */
    double ground_height;                           /* height along up [m], default 0 */
    frond_vec3 up;                                  /* normal of the ground, towards the sky; default (0, 1, 0) */
    frond_color ground_color;                       /* as displayed where the sun shines on it */
    uint32_t cookie;                                /* do not set */
} frond_picture_scene;

frond_picture_scene frond_default_picture_scene(void);
/* Returns a camera that sees the whole box and looks at its middle. up: of the world. azimuth: around up [rad]; 0
 * looks along -z if up is +y (along +y if it is +z). elevation: above the horizon, -pi/2..pi/2. aspect: width /
 * height of the picture. A box that is not finite or an invalid aspect gives the camera for the unit box. */
frond_picture_camera frond_picture_frame(frond_vec3 lower, frond_vec3 upper, frond_vec3 up, double azimuth,
                                         double elevation, double aspect);

/* Discards everything drawn and begins a frame. Null: the default scene, looking at the unit box. */
bool frond_picture_begin(frond_picture* picture, const frond_picture_scene* scene);
/* Draws the frame. Fails outside of a frame. */
bool frond_picture_end(frond_picture* picture);
/* Returns the last finished frame, width*height*3. Borrowed until the next end or destroy. Null before the first. */
const uint8_t* frond_picture_get_pixels(frond_picture* picture);
bool frond_picture_write(frond_picture* picture, const char* png_path);
/* Gives all surfaces that are drawn from now on in this frame a number, at its beginning 0; a frame in which it was
 * called is measured, too: */
bool frond_picture_set_id(frond_picture* picture, int32_t id);
/* Returns the number of the surface in the middle of each pixel of the last finished frame, and its distance along the
 * camera's axis [m], width*height each, rows from top to bottom; -1 and infinity where there is none. Ground, glass and
 * overlays are not measured. Borrowed until the next end or destroy. Null if the frame was not measured. */
const int32_t* frond_picture_get_ids(frond_picture* picture);
const float* frond_picture_get_distances(frond_picture* picture);
/* Copies the last finished frame to a framebuffer of the caller's context (FROND_PICTURE_CURRENT only); 0 is the
 * window. */
bool frond_picture_present(frond_picture* picture, unsigned framebuffer, int width, int height);

/* ---- surfaces ----------------------------------------------------------------------------------------------- */

/* Adds a texture. bytes: of an image file (PNG, JPEG, BMP, TGA, WebP), decoded here. The same bytes give the same
 * texture. Textures live as long as the picture. out: for frond_picture_part.texture. */
bool frond_picture_add_texture(frond_picture* picture, const uint8_t* bytes, size_t byte_count, int* out);

/* A run of triangles with one appearance. */
typedef struct frond_picture_part {
    int first_triangle, triangle_count;
    frond_color color;  /* multiplied with texture and vertex colour; alpha below 1 of a texture cuts leaves out */
    int texture;        /* -1: none */
    float translucency; /* share of light that passes a thin sheet, 0..1; 0.35 for a leaf, 0 for wood */
    float gloss;        /* 0..1; 0.3 for a leaf */
    bool is_floor;      /* casts no shadow; of a wide floor, which would take all of the shadow maps */
} frond_picture_part;

/* All sheets are two-sided. Triangles outside all parts are not drawn; without parts all are drawn as a leaf. */
typedef struct frond_picture_mesh {
    const float* positions; /* vertex_count*3 [m] */
    const float* normals;   /* vertex_count*3, or null: flat faces */
    const float* uvs;       /* vertex_count*2, or null; v = 0 is the texture's top row */
    const uint8_t* colors;  /* vertex_count*4, RGBA, or null */
    const int32_t* indices; /* triangle_count*3 */
    int vertex_count, triangle_count;
    const frond_picture_part* parts; /* or null */
    int part_count;
} frond_picture_mesh;

bool frond_picture_draw_mesh(frond_picture* picture, const frond_picture_mesh* mesh);
/* Draw rigid bodies. With an alpha below 1 they are glass: they cast no shadow and are blended over the background. */
bool frond_picture_draw_sphere(frond_picture* picture, frond_vec3 center, double radius, frond_color color);
bool frond_picture_draw_box(frond_picture* picture, frond_vec3 center, frond_quat rotation, frond_vec3 half_extents,
                            frond_color color);
bool frond_picture_draw_capsule(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double radius,
                                frond_color color);

/* ---- overlays: visible through surfaces, fainter where hidden, unlit -------------------------------------------- */

bool frond_picture_draw_line(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double width, frond_color color);
/* Draws a line with a head at its end, as for a force. */
bool frond_picture_draw_arrow(frond_picture* picture, frond_vec3 begin, frond_vec3 end, double width,
                              frond_color color);
/* Draws a dot, as for a contact. size: diameter. */
bool frond_picture_draw_point(frond_picture* picture, frond_vec3 point, double size, frond_color color);
/* Draws a cage: every edge as a line of `width` (0: none) in `line`, and the outer faces in `fill` (alpha 0: none).
 * nodes: node_count*3 [m]; tets: tet_count*4. */
bool frond_picture_draw_tets(frond_picture* picture, const double* nodes, int node_count, const int32_t* tets,
                             int tet_count, double width, frond_color line, frond_color fill);

/* ---- plants (library frond_picture_plant) ------------------------------------------------------------------------ */

enum {
    FROND_PICTURE_SURFACE = 1 << 0,
    FROND_PICTURE_CAGE = 1 << 1,       /* edges of the cage */
    FROND_PICTURE_CAGE_FACES = 1 << 2, /* outer faces of the cage, translucent */
    FROND_PICTURE_CAPSULES = 1 << 3,   /* translucent */
    FROND_PICTURE_CONTACTS = 1 << 4    /* dots where bodies touched it in the last step, red if they pushed */
};
/* Draws a plant as it is now, with its model's colours and textures. what: bits of the above. A texture that cannot
 * be decoded is omitted. */
bool frond_picture_draw_plant(frond_picture* picture, frond_plant plant, frond_model model, uint32_t what);
/* Draws a rigid body made by Frond, as it is now; a plane is left to the scene's ground. */
bool frond_picture_draw_rigid(frond_picture* picture, const frond_rigid_def* def, frond_rigid rigid, frond_color color);
/* Draws the collision shapes of a robot's links. */
bool frond_picture_draw_robot(frond_picture* picture, frond_robot robot, frond_color color);
/* Draws a red arrow from the held point to its target. */
bool frond_picture_draw_grab(frond_picture* picture, frond_grab grab);

/* ---- files ------------------------------------------------------------------------------------------------------- */

bool frond_picture_write_png(const char* path, const uint8_t* rgb, int width, int height);
/* Reads any PNG up to FROND_PICTURE_LARGEST, blended over black. Free *out by frond_picture_free. */
bool frond_picture_read_png(const char* path, uint8_t** out, int* width, int* height);
void frond_picture_free(uint8_t* pixels);

/* Frames of a run, written as a moving picture and as a contact sheet. */
typedef struct frond_film_def {
    int width, height;        /* size of a frame, 1..FROND_PICTURE_LARGEST */
    double frames_per_second; /* 1..1000, default 30 */
    double quality;           /* quality of the moving picture, 0..100, default 80 */
    int effort;               /* time spent on reducing the file's size, 0..6, default 2 */
    int sheet_width;          /* width of a frame on the contact sheet [pixel], default 320; 0: no sheet is kept */
    bool moving;              /* default true; false: no moving picture is kept */
    uint32_t cookie;          /* do not set */
} frond_film_def;
typedef struct frond_film frond_film;

frond_film_def frond_default_film_def(void);
bool frond_film_create(const frond_film_def* def, frond_film** out);
/* Ignores null and destroyed films. */
void frond_film_destroy(frond_film* film);
/* Adds a frame. rgb: width*height*3 of the def. */
bool frond_film_add(frond_film* film, const uint8_t* rgb);
/* Returns 0 for a null or destroyed film. */
int frond_film_get_frame_count(const frond_film* film);
/* Writes an animated WebP with an endless loop. Afterwards nothing can be added. */
bool frond_film_write_webp(frond_film* film, const char* path);
/* Writes a sheet of at most columns*rows frames, evenly spaced from the first to the last. */
bool frond_film_write_sheet(frond_film* film, const char* png_path, int columns, int rows);

/* ---- comparison ------------------------------------------------------------------------------------------------ */

/* Colour differences are Delta E of CIE L*a*b*: 2.3 is just noticeable, 100 is black against white. Each picture is
 * softened a little and offsets of up to one pixel are tolerated, as each machine rasterises edges differently. */
typedef struct frond_picture_difference {
    double worst;         /* largest mean difference over a window of 9 x 9 pixels [Delta E] */
    int worst_x, worst_y; /* middle of that window */
    double mean;          /* mean over the whole picture [Delta E] */
    double share;         /* share of pixels that differ by more than 2.3 [-] */
    bool same;            /* worst <= tolerance */
} frond_picture_difference;
#define FROND_PICTURE_TOLERANCE 3.5 /* tolerance for reference pictures [Delta E] */

/* a, b: width*height*3. difference_rgb: null, or width*height*3, which receives the difference, black over red to
 * white. */
bool frond_picture_compare(const uint8_t* a, const uint8_t* b, int width, int height, double tolerance,
                           frond_picture_difference* out, uint8_t* difference_rgb);
/* Compares pixels with a reference PNG. If they are not the same, also if the sizes differ, and difference_png is
 * not null, writes reference, picture and difference side by side there. Returns false if the reference cannot be
 * read or has another size. */
bool frond_picture_compare_file(const uint8_t* rgb, int width, int height, const char* reference_png, double tolerance,
                                frond_picture_difference* out, const char* difference_png);

#ifdef __cplusplus
}
#endif
#endif /* FROND_PICTURE_H */
