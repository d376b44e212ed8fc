// In: an EGL platform. Out: an OpenGL 3.3 core context without a window.
// EGL_MESA_platform_surfaceless needs Mesa; EGL_EXT_platform_device works with vendors' drivers too.
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <vector>

#include "context.hpp"
#include "error.hpp"

namespace picture {

struct Context {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;  // EGL_NO_CONTEXT: the caller's own
    const char* platform = "";
};

namespace {

std::string egl_error(const char* what) {
    char text[80];
    std::snprintf(text, sizeof text, "%s gives EGL error 0x%04x", what, unsigned(eglGetError()));
    return text;
}

// libepoxy ends the program when a library is missing; this check keeps the host alive.
void require_libraries() {
    if (!dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL))
        fail("there is no libEGL.so.1 on this machine; install libegl1 and libgl1-mesa-dri");
    if (!dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_GLOBAL) && !dlopen("libGL.so.1", RTLD_LAZY | RTLD_GLOBAL))
        fail("there is neither libOpenGL.so.0 nor libGL.so.1 on this machine; install libopengl0 or libgl1");
}

// A display is shared by all contexts of the process, including the host's, so it is never terminated.
bool open_display(Context& context, EGLDisplay display, std::string& why) {
    if (display == EGL_NO_DISPLAY) return why = egl_error("eglGetPlatformDisplay"), false;
    if (!eglInitialize(display, nullptr, nullptr)) return why = egl_error("eglInitialize"), false;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context"))
        return why = "the driver wants a surface", false;
    if (!eglBindAPI(EGL_OPENGL_API)) return why = egl_error("eglBindAPI"), false;

    // No config is needed when nothing is drawn to a surface, but older drivers require one.
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLint count = 0;
        if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
            return why = egl_error("eglChooseConfig"), false;
    }
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context.context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context.context == EGL_NO_CONTEXT) return why = egl_error("eglCreateContext for OpenGL 3.3"), false;
    context.display = display;
    return true;
}

bool open_surfaceless(Context& context, std::string& why) {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        return why = "EGL_MESA_platform_surfaceless is missing", false;
    context.platform = "surfaceless";
    return open_display(context, eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), why);
}

bool open_device(Context& context, std::string& why) {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device"))
        return why = "EGL_EXT_platform_device is missing", false;
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (!eglQueryDevicesEXT(16, devices, &count)) return why = egl_error("eglQueryDevicesEXT"), false;
    why = "there is no device";
    context.platform = "device";
    for (EGLint i = 0; i < count; i++)
        if (open_display(context, eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr), why))
            return true;
    return false;
}

}  // namespace

ContextPointer create_context(frond_picture_platform platform) {
    require_libraries();
    ContextPointer context(new Context);
    if (platform == FROND_PICTURE_CURRENT) {
        if (eglGetCurrentContext() == EGL_NO_CONTEXT)
            fail("no EGL context is current; make yours current first, or use FROND_PICTURE_ANY");
        context->platform = "current";
        return context;
    }
    const EGLenum previous_api = eglQueryAPI();
    std::string why, said;
    bool opened = false;
    if (platform != FROND_PICTURE_DEVICE) {
        opened = open_surfaceless(*context, why);
        said += opened ? "" : "surfaceless: " + why + "; ";
    }
    if (!opened && platform != FROND_PICTURE_SURFACELESS) {
        opened = open_device(*context, why);
        said += opened ? "" : "device: " + why + "; ";
    }
    eglBindAPI(previous_api);
    if (!opened)
        fail("cannot make an OpenGL context: %sinstall libegl1 and libgl1-mesa-dri, or choose the other platform",
             said.c_str());
    return context;
}

const char* platform_name(const Context& context) {
    return context.platform;
}

void ContextDeleter::operator()(Context* context) const noexcept {
    if (context->context != EGL_NO_CONTEXT) eglDestroyContext(context->display, context->context);
    delete context;
}

Current::Current(const Context& context) {
    // The caller's own context must be current already; it must not be guessed.
    if (context.context == EGL_NO_CONTEXT) {
        if (eglGetCurrentContext() == EGL_NO_CONTEXT)
            fail("the picture draws with the caller's context, but none is current; make it current first");
        return;
    }
    api_ = eglQueryAPI();
    display_ = eglGetCurrentDisplay();
    context_ = eglGetCurrentContext();
    draw_ = eglGetCurrentSurface(EGL_DRAW);
    read_ = eglGetCurrentSurface(EGL_READ);
    eglBindAPI(EGL_OPENGL_API);
    if (!eglMakeCurrent(context.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context)) {
        const std::string why = egl_error("eglMakeCurrent");
        eglBindAPI(api_);
        fail("cannot draw: %s; is the picture in use by another thread?", why.c_str());
    }
    used_display_ = context.display;
}

Current::~Current() {
    if (!used_display_) return;
    eglMakeCurrent(used_display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglBindAPI(api_);
    if (context_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, draw_, read_, context_);
}

}  // namespace picture
