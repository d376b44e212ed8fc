// Studio and film of a build without pictures (FROND_PICTURES): they refuse.
#include "studio/studio.hpp"

namespace frond::tools {

[[noreturn]] static void refuse() {
    throw SceneError("this frond was built without pictures; leave --shot and --frames out");
}

Studio::Studio(const View&) {
    refuse();
}
Studio::~Studio() = default;
const uint8_t* Studio::shoot(const Stage&) {
    refuse();
}
void Studio::write(const std::string&) {
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
