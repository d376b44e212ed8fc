/* What garden.c gives to a page and to native.c, which measures the same without a browser. */
#ifndef FROND_GARDEN_H
#define FROND_GARDEN_H

#include <frond/frond.h>
#include <stddef.h>
#include <stdint.h>

/* The field's corn has 41 capsules, as that of tools/scenes/field.cpp; the other has 165. */
enum { MODEL_CORN, MODEL_CUCUMBER, MODEL_FIELD_CORN, MODEL_COUNT };
enum { SCENE_CORN, SCENE_CUCUMBER, SCENE_ROW, SCENE_FIELD, SCENE_COUNT };

int garden_failed(void);
const char* garden_error(void);
double garden_take_model(int which, const void* bytes, size_t size);
int garden_open(int scene, int mechanics, int integrator, uint32_t effects, double wind, int plants);
void garden_step(double dt);
/* Returns what runs jobs by so many threads, the caller's among them; null if there is but that one. */
frond_parallel_for_fn* garden_threads(int count);
void garden_get_hash(uint32_t* out);

#endif
