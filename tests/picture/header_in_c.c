/* The header must stay C99: this file uses it as a C program would. */
#include "frond_picture.h"

int picture_header_works_in_c(void) {
    frond_picture_def def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film = frond_default_film_def();
    return def.width == 1280 && scene.ground && film.moving && FROND_PICTURE_TOLERANCE > 0;
}
