// Studio and film of a build without pictures (FROND_PICTURES): they refuse.
#include "studio/organ_picture.hpp"

namespace frond::tools {

[[noreturn]] static void refuse() {
    throw SceneError("this frond was built without pictures; leave --shot, --picture and --frames out");
}

Studio::Studio(const View&) {
    refuse();
}
Studio::~Studio() = default;
const uint8_t* Studio::shoot(const Stage&) {
    refuse();
}
frond_picture_scene Studio::draw(const Stage&, const std::function<void(frond_picture*)>&) {
    refuse();
}
void Studio::write(const std::string&) {
    refuse();
}

Canvas draw_organs(const Stage&, const View&) {
    refuse();
}
void Canvas::write(const std::string&) const {
    refuse();
}

Film::Film(const std::string&, const View&, double) {
    refuse();
}
Film::~Film() = default;
void Film::add(Studio&, const Stage&) {
    refuse();
}
void Film::finish() {
    refuse();
}

}  // namespace frond::tools
