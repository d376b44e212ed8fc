// Context: an OpenGL context without a window, or the caller's own. It is independent of drawing.
#pragma once

#include <memory>
#include <string>

#include "frond_picture.h"

namespace picture {

struct Context;
struct ContextDeleter {
    void operator()(Context* context) const noexcept;
};
using ContextPointer = std::unique_ptr<Context, ContextDeleter>;

// Tries the platforms that the choice allows; fails with the error of each of them.
ContextPointer create_context(frond_picture_platform platform);
// Returns "surfaceless", "device" or "current".
const char* platform_name(const Context& context);

// Makes a context current for a scope and then restores the previous one.
class Current {
public:
    explicit Current(const Context& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

private:
    void *display_ = nullptr, *context_ = nullptr, *draw_ = nullptr, *read_ = nullptr;
    void* used_display_ = nullptr;
    unsigned api_ = 0;
};

}  // namespace picture
