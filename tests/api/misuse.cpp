// Every public function, called wrongly: it returns a code and a text that names the remedy, changes nothing and does
// not crash.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

#include "support/materials.hpp"
#include "support/stems.hpp"

extern "C" int frond_hello_from_c(double* tip_height);

static const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
static const double INFINITE = std::numeric_limits<double>::infinity();

// Returns whether the last error names what was wrong.
static ::testing::AssertionResult error_names(const char* word) {
    if (std::strstr(frond_last_error(), word)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "\"" << frond_last_error() << "\" does not name " << word;
}

TEST(Header, WorksFromC) {
    double tip_height = 0;
    EXPECT_EQ(frond_hello_from_c(&tip_height), 0);
    EXPECT_GT(tip_height, 0.4);
}

TEST(Header, EveryEnumHasANameAndOutOfRangeHasOneToo) {
    for (int i = 0; i < FROND_RESULT_COUNT; i++) EXPECT_GT(std::strlen(frond_result_name(frond_result(i))), 1u);
    EXPECT_STREQ(frond_result_name(frond_result(-1)), "unknown result");
    EXPECT_STREQ(frond_result_name(FROND_RESULT_COUNT), "unknown result");
    EXPECT_STREQ(frond_mechanics_name(FROND_MECHANICS_TET_COROTATIONAL), "tet_corotational");
    EXPECT_STREQ(frond_mechanics_name(frond_mechanics(99)), "?");
    EXPECT_STREQ(frond_integrator_name(frond_integrator(-5)), "?");
    EXPECT_STREQ(frond_linear_solver_name(FROND_LINEAR_SOLVER_BLOCK), "block");
    EXPECT_STREQ(frond_mass_name(FROND_MASS_CONSISTENT), "consistent");
    EXPECT_STREQ(frond_hash_layout_name(FROND_HASH_LAYOUT_PAPER), "paper");
    EXPECT_STREQ(frond_hash_layout_name(frond_hash_layout(-1)), "?");
    EXPECT_STREQ(frond_response_name(FROND_RESPONSE_IMPULSE), "impulse");
    EXPECT_STREQ(frond_response_name(FROND_RESPONSE_COUNT), "?");
    EXPECT_STREQ(frond_detail_name(FROND_DETAIL_MODAL), "modal");
    EXPECT_STREQ(frond_detail_name(FROND_DETAIL_COUNT), "?");
    EXPECT_STREQ(frond_effect_name(FROND_EFFECT_WIND), "wind");
    EXPECT_STREQ(frond_effect_name(FROND_EFFECT_WIND | FROND_EFFECT_GRAVITY), "?");
    EXPECT_STREQ(frond_effect_name(1u << FROND_EFFECT_COUNT), "?");
}

TEST(Header, HasTheLibrarysVersion) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%d.%d.%d", FROND_VERSION_MAJOR, FROND_VERSION_MINOR, FROND_VERSION_PATCH);
    EXPECT_STREQ(frond_version_string(), numbers);
    EXPECT_STREQ(FROND_VERSION_STRING, numbers);
    EXPECT_EQ(FROND_VERSION, FROND_VERSION_MAJOR * 65536 + FROND_VERSION_MINOR * 256 + FROND_VERSION_PATCH);
}

// A header of another version may have another layout, so only the cookie, which comes first, is written and read.
TEST(Header, OfAnotherVersionMakesDefsThatAreRefused) {
    SmallWorld small;
    frond_plant_def def = frond_default_plant_def(), untouched = def;
    const uint32_t other = FROND_DEF_COOKIE('P') + 0x100;
    frond_fill_def(&def, other);
    EXPECT_EQ(def.cookie, other);
    untouched.cookie = other;
    EXPECT_EQ(std::memcmp(&def, &untouched, sizeof def), 0);
    frond_plant plant = {7};
    EXPECT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_RESULT_BAD_DEF);
    EXPECT_EQ(plant.id, 0u);
    char version[64];
    std::snprintf(version, sizeof version, "made by the header of version %d.%d.", FROND_VERSION_MAJOR,
                  FROND_VERSION_MINOR + 1);
    EXPECT_TRUE(error_names(version));
    EXPECT_TRUE(error_names(frond_version_string()));
    // Another patch version has the same API; a def of another kind is a different mistake.
    frond_fill_def(&def, FROND_DEF_COOKIE('P') + 1);
    EXPECT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_OK);
    def.cookie = FROND_DEF_COOKIE('W');
    EXPECT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_RESULT_BAD_DEF);
    EXPECT_TRUE(error_names("frond_default_plant_def"));
    frond_fill_def(nullptr, FROND_DEF_COOKIE('P'));
}

TEST(Header, GivesAMaterialToBeginWith) {
    frond_material stem;
    ASSERT_EQ(frond_material_preset("stem", &stem), FROND_OK);
    const frond_material material = frond_default_material();
    EXPECT_EQ(std::memcmp(&material, &stem, sizeof stem), 0);
}

TEST(Misuse, OfDetailIsRefused) {
    SmallWorld small;
    frond_detail_def def = {};
    EXPECT_EQ(frond_world_set_detail(small.world, &def), FROND_RESULT_BAD_DEF);
    EXPECT_TRUE(error_names("frond_default_detail_def"));
    def = frond_default_detail_def();
    EXPECT_EQ(frond_world_set_detail({}, &def), FROND_RESULT_BAD_HANDLE);
    def.modal_from = def.half_from - 1;
    EXPECT_EQ(frond_world_set_detail(small.world, &def), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("modal_from"));
    def = frond_default_detail_def();
    def.hysteresis = 1;
    EXPECT_EQ(frond_world_set_detail(small.world, &def), FROND_RESULT_BAD_ARGUMENT);
    def = frond_default_detail_def();
    def.budget = NOT_A_NUMBER;
    EXPECT_EQ(frond_world_set_detail(small.world, &def), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("budget"));
    EXPECT_EQ(frond_world_set_viewer(small.world, {0, INFINITE, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("position"));
    frond_detail detail = FROND_DETAIL_STILL;
    EXPECT_EQ(frond_plant_get_detail({}, &detail), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(detail, FROND_DETAIL_FULL);
    EXPECT_EQ(frond_plant_get_detail(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
}

TEST(Misuse, OfWorldsIsRefused) {
    frond_world_def def = frond_default_world_def();
    frond_world world = {7};
    EXPECT_EQ(frond_world_create(nullptr, &world), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(world.id, 0u);
    EXPECT_EQ(frond_world_create(&def, nullptr), FROND_RESULT_BAD_ARGUMENT);
    frond_world_def zero = {};
    EXPECT_EQ(frond_world_create(&zero, &world), FROND_RESULT_BAD_DEF);
    EXPECT_TRUE(error_names("frond_default_world_def"));
    def.gravity.y = NOT_A_NUMBER;
    EXPECT_EQ(frond_world_create(&def, &world), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("gravity"));
    def = frond_default_world_def();
    def.max_substep = 0;
    EXPECT_EQ(frond_world_create(&def, &world), FROND_RESULT_BAD_ARGUMENT);
    def = frond_default_world_def();
    def.effects = ~0u;
    EXPECT_EQ(frond_world_create(&def, &world), FROND_RESULT_BAD_ARGUMENT);
    const std::pair<const char*, void (*)(frond_world_def&)> wrong[] = {
        {"hash_layout", [](frond_world_def& d) { d.tuning.hash_layout = frond_hash_layout(FROND_HASH_LAYOUT_COUNT); }},
        {"hash_table_size", [](frond_world_def& d) { d.tuning.hash_table_size = -1; }},
        {"hash_cell_size", [](frond_world_def& d) { d.tuning.hash_cell_size = NOT_A_NUMBER; }},
        {"response", [](frond_world_def& d) { d.response = frond_response(-1); }},
        {"response_iterations", [](frond_world_def& d) { d.tuning.response_iterations = 0; }},
        {"response_tolerance", [](frond_world_def& d) { d.tuning.response_tolerance = 2; }},
        {"penalty_stiffness", [](frond_world_def& d) { d.tuning.penalty_stiffness = INFINITE; }}};
    for (const auto& [word, change] : wrong) {
        def = frond_default_world_def();
        change(def);
        EXPECT_EQ(frond_world_create(&def, &world), FROND_RESULT_BAD_ARGUMENT) << word;
        EXPECT_TRUE(error_names(word));
    }

    const frond_world null_world = {}, nonsense = {0x1234567890abcdefu};
    frond_report report;
    frond_profile profile;
    uint64_t hash = 5;
    frond_ray_hit hit;
    for (frond_world bad : {null_world, nonsense}) {
        EXPECT_EQ(frond_world_step(bad, 0.01), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_world_set_gravity(bad, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_world_set_effects(bad, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_world_get_report(bad, &report), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_world_get_profile(bad, &profile), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_world_get_state_hash(bad, &hash), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(hash, 0u);
        EXPECT_EQ(frond_world_cast_ray(bad, {0, 0, 0}, {1, 0, 0}, 1, &hit), FROND_RESULT_BAD_HANDLE);
        EXPECT_FALSE(frond_world_is_valid(bad));
        frond_world_destroy(bad);
    }
}

TEST(Misuse, OfAStepIsRefusedAndChangesNothing) {
    SmallWorld small;
    uint64_t before = 0, after = 0;
    frond_world_get_state_hash(small.world, &before);
    for (double dt : {-0.1, 1.5, NOT_A_NUMBER, INFINITE})
        EXPECT_EQ(frond_world_step(small.world, dt), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_set_gravity(small.world, {0, INFINITE, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_set_effects(small.world, 1u << 31), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_report(small.world, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_profile(small.world, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_state_hash(small.world, nullptr), FROND_RESULT_BAD_ARGUMENT);
    frond_ray_hit hit;
    EXPECT_EQ(frond_world_cast_ray(small.world, {0, 0, 0}, {0, 0, 0}, 1, &hit), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_cast_ray(small.world, {0, 0, 0}, {1, 0, 0}, -1, &hit), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_cast_ray(small.world, {NOT_A_NUMBER, 0, 0}, {1, 0, 0}, 1, &hit), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_cast_ray(small.world, {0, 0, 0}, {1, 0, 0}, 1, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_step(small.world, 0), FROND_OK);
    frond_world_get_state_hash(small.world, &after);
    EXPECT_EQ(before, after);
}

TEST(Misuse, OfModelsIsRefused) {
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_load(nullptr, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_load("no/such/plant.obj", &def, &model), FROND_RESULT_FILE_NOT_FOUND);
    EXPECT_TRUE(error_names("no/such/plant.obj"));
    EXPECT_EQ(frond_model_load("x.obj", nullptr, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_load("x.obj", &def, nullptr), FROND_RESULT_BAD_ARGUMENT);
    frond_model_def zero = {};
    EXPECT_EQ(frond_model_load("x.obj", &zero, &model), FROND_RESULT_BAD_DEF);

    const float xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const int32_t indices[] = {0, 1, 2}, wild[] = {0, 1, 300};
    EXPECT_EQ(frond_model_from_triangles(nullptr, 3, indices, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_triangles(xyz, 3, nullptr, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_triangles(xyz, -3, indices, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_triangles(xyz, 3, indices, 2000000000, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_triangles(xyz, 3, wild, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("300"));
    const float nan_xyz[] = {NAN, 0, 0, 1, 0, 0, 0, 1, 0}, point_xyz[9] = {};
    EXPECT_EQ(frond_model_from_triangles(nan_xyz, 3, indices, 1, &def, &model), FROND_RESULT_BAD_GEOMETRY);
    EXPECT_EQ(frond_model_from_triangles(point_xyz, 3, indices, 1, &def, &model), FROND_RESULT_BAD_GEOMETRY);

    const frond_stem good = {-1, {0, 0, 0}, {0, 1, 0}, 0.1, 0.1};
    for (frond_stem stem :
         {frond_stem{5, good.begin, good.end, 0.1, 0.1}, frond_stem{0, good.begin, good.end, 0.1, 0.1},
          frond_stem{-1, good.begin, good.end, -0.1, 0.1}, frond_stem{-1, good.begin, {NOT_A_NUMBER, 0, 0}, 0.1, 0.1},
          frond_stem{-1, good.begin, good.begin, 0.1, 0.1}})
        EXPECT_NE(frond_model_from_stems(&stem, 1, &def, &model), FROND_OK);
    EXPECT_EQ(frond_model_from_stems(nullptr, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_stems(&good, 0, &def, &model), FROND_RESULT_BAD_ARGUMENT);

    const double nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const int32_t tet[] = {0, 1, 2, 3}, wild_tet[] = {0, 1, 2, 9}, double_tet[] = {0, 1, 2, 2};
    EXPECT_EQ(frond_model_from_tets(nodes, 4, wild_tet, 1, &def, &model), FROND_RESULT_BAD_GEOMETRY);
    EXPECT_EQ(frond_model_from_tets(nodes, 4, double_tet, 1, &def, &model), FROND_RESULT_BAD_GEOMETRY);
    EXPECT_EQ(frond_model_from_tets(flat, 4, tet, 1, &def, &model), FROND_RESULT_BAD_GEOMETRY);
    EXPECT_EQ(frond_model_from_tets(nullptr, 4, tet, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);

    frond_model_def wrong = def;
    wrong.cage_smoothness = 2;
    EXPECT_EQ(frond_model_from_stems(&good, 1, &wrong, &model), FROND_RESULT_BAD_ARGUMENT);
    wrong = def;
    wrong.cage_size = NOT_A_NUMBER;
    EXPECT_EQ(frond_model_from_stems(&good, 1, &wrong, &model), FROND_RESULT_BAD_ARGUMENT);
    const frond_organ_material unknown = {"pancake", plain_material(1000, 1e8, 0.3, 1e-3)};
    wrong = def;
    wrong.organs = &unknown;
    wrong.organ_count = 1;
    EXPECT_EQ(frond_model_from_stems(&good, 1, &wrong, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("pancake"));
    frond_material material;
    EXPECT_EQ(frond_material_preset("pancake", &material), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("blade"));
    EXPECT_EQ(frond_material_preset(nullptr, &material), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(model.id, 0u);

    frond_model_info info;
    frond_part part;
    frond_organ organ;
    frond_texture_view texture;
    frond_cage_view cage;
    frond_chain_view chain;
    EXPECT_EQ(frond_model_get_info({}, &info), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_part({}, 0, &part), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_organ({}, 0, &organ), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_texture({}, 0, &texture), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_cage({}, &cage), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_chain({}, &chain), FROND_RESULT_BAD_HANDLE);
    frond_model_destroy({});
    ASSERT_EQ(frond_model_from_stems(&good, 1, &def, &model), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_model_get_info(model, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_get_part(model, 1000, &part), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_get_part(model, -1, &part), FROND_RESULT_BAD_ARGUMENT);
    ASSERT_EQ(frond_model_get_info(model, &info), FROND_OK);
    EXPECT_EQ(frond_model_get_organ(model, 0, nullptr), FROND_RESULT_BAD_ARGUMENT);
    for (int none : {-1, info.organ_count, 1 << 30}) {
        organ.name = "old";
        EXPECT_EQ(frond_model_get_organ(model, none, &organ), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(organ.name, nullptr);
    }
    EXPECT_EQ(frond_model_get_texture(model, 0, &texture), FROND_RESULT_BAD_ARGUMENT);
    std::vector<int32_t> organs(size_t(info.capsule_count), -2);
    EXPECT_EQ(frond_model_get_capsule_organs({}, organs.data(), info.capsule_count), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_capsule_organs(model, nullptr, info.capsule_count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_get_capsule_organs(model, organs.data(), info.capsule_count + 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(organs, std::vector<int32_t>(size_t(info.capsule_count), -2));
    EXPECT_EQ(frond_model_get_capsule_organs(model, organs.data(), info.capsule_count), FROND_OK);
    EXPECT_EQ(organs, std::vector<int32_t>(size_t(info.capsule_count), 0));
    frond_model_destroy(model);
    frond_model_destroy(model);
    EXPECT_FALSE(frond_model_is_valid(model));
    EXPECT_EQ(frond_model_get_info(model, &info), FROND_RESULT_BAD_HANDLE);
}

TEST(Misuse, OfPlantsIsRefused) {
    SmallWorld small;
    frond_plant plant = {};
    frond_plant_def def = frond_default_plant_def();
    EXPECT_EQ(frond_plant_create({}, small.model, &def, &plant), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_create(small.world, {}, &def, &plant), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_create(small.world, {small.world.id}, &def, &plant), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_create(small.world, small.model, nullptr, &plant), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_create(small.world, small.model, &def, nullptr), FROND_RESULT_BAD_ARGUMENT);
    const auto refuses = [&](auto change) {
        frond_plant_def changed = def;
        change(changed);
        return frond_plant_create(small.world, small.model, &changed, &plant) == FROND_RESULT_BAD_ARGUMENT;
    };
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.position.x = NOT_A_NUMBER; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.rotation = {0, 0, 0, 0}; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.mechanics = frond_mechanics(77); }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.integrator = frond_integrator(-1); }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.linear_solver = frond_linear_solver(9); }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.mass = frond_mass(9); }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.newton_iterations = 0; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.element_order = 0; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.element_order = 3; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.linear_iterations = -1; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.linear_tolerance = NOT_A_NUMBER; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.mass_damping = -1; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.stiffness_damping = INFINITE; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.material_damping = -1; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.root_height = NOT_A_NUMBER; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.spectral_radius = 1.5; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.tuning.spectral_radius = NOT_A_NUMBER; }));
    EXPECT_TRUE(refuses([](frond_plant_def& d) { d.effects = ~0u; }));
    def.cookie = 0;
    EXPECT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_RESULT_BAD_DEF);
    EXPECT_EQ(plant.id, 0u);
    frond_report report;
    frond_world_get_report(small.world, &report);
    EXPECT_EQ(report.plant_count, 1);

    const int count = frond_plant_get_node_count(small.plant);
    std::vector<double> numbers(size_t(3 * count), 0.0);
    EXPECT_EQ(frond_plant_get_state(small.plant, numbers.data(), nullptr, count - 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_state(small.plant, numbers.data(), nullptr, count + 1), FROND_RESULT_BAD_ARGUMENT);
    numbers[4] = NOT_A_NUMBER;
    EXPECT_EQ(frond_plant_set_state(small.plant, nullptr, numbers.data(), count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_plastic_count(small.plant), 0);
    EXPECT_EQ(frond_plant_get_plastic(small.plant, numbers.data(), 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_plastic(small.plant, numbers.data(), 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_plastic(small.plant, nullptr, 10), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_plastic(small.plant, nullptr, -1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_plastic(small.plant, nullptr, 0), FROND_OK);
    for (int node : {-1, count, 1 << 30}) {
        EXPECT_EQ(frond_plant_pin(small.plant, node), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(frond_plant_unpin(small.plant, node), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(frond_plant_move_pin(small.plant, node, {0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(frond_plant_add_force(small.plant, node, {0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    }
    EXPECT_EQ(frond_plant_unpin(small.plant, 0), FROND_OK);
    EXPECT_EQ(frond_plant_move_pin(small.plant, 0, {0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("frond_plant_pin"));
    EXPECT_EQ(frond_plant_add_force(small.plant, 0, {0, NOT_A_NUMBER, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_effects(small.plant, ~0u), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_energy(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_surface(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_capsules(small.plant, nullptr, 3), FROND_RESULT_BAD_ARGUMENT);
    frond_capsule capsule;
    EXPECT_EQ(frond_plant_get_capsules(small.plant, &capsule, 1000), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_tip(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
}

TEST(Misuse, OfStalePlantsIsRecognised) {
    SmallWorld small;
    frond_grab grab = {};
    ASSERT_EQ(frond_grab_create(small.plant, {0, 0.6, 0}, 10, &grab), FROND_OK);
    frond_plant_destroy(small.plant);
    frond_plant_destroy(small.plant);
    const frond_plant null_plant = {};
    frond_surface_view view;
    frond_energy energy;
    frond_vec3 tip;
    frond_capsule capsule;
    for (frond_plant bad : {small.plant, null_plant}) {
        EXPECT_FALSE(frond_plant_is_valid(bad));
        EXPECT_EQ(frond_plant_get_node_count(bad), 0);
        EXPECT_EQ(frond_plant_get_capsule_count(bad), 0);
        EXPECT_EQ(frond_plant_get_user(bad), nullptr);
        EXPECT_EQ(frond_plant_set_effects(bad, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_plastic_count(bad), 0);
        EXPECT_EQ(frond_plant_get_plastic(bad, nullptr, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_set_plastic(bad, nullptr, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_state(bad, nullptr, nullptr, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_set_state(bad, nullptr, nullptr, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_pin(bad, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_unpin(bad, 0), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_move_pin(bad, 0, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_add_force(bad, 0, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_energy(bad, &energy), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_surface(bad, &view), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(view.positions, nullptr);
        EXPECT_EQ(frond_plant_get_capsules(bad, &capsule, 1), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_tip(bad, &tip), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_grab_create(bad, {0, 0, 0}, 10, &grab), FROND_RESULT_BAD_HANDLE);
    }
}

TEST(Misuse, OfGrabsIsRefused) {
    SmallWorld small;
    frond_grab grab = {};
    EXPECT_EQ(frond_grab_create(small.plant, {0, NOT_A_NUMBER, 0}, 10, &grab), FROND_RESULT_BAD_ARGUMENT);
    for (double stiffness : {0.0, -5.0, NOT_A_NUMBER, INFINITE})
        EXPECT_EQ(frond_grab_create(small.plant, {0, 1, 0}, stiffness, &grab), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_grab_create(small.plant, {0, 1, 0}, 10, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(grab.id, 0u);
    EXPECT_EQ(frond_grab_move(grab, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
    frond_grab_destroy(grab);

    ASSERT_EQ(frond_grab_create(small.plant, {0, 1, 0}, 10, &grab), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_grab_move(grab, {0, INFINITE, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_grab_get(grab, nullptr, nullptr, nullptr), FROND_OK);
    frond_plant_destroy(small.plant);  // its grabs are destroyed with it
    EXPECT_FALSE(frond_grab_is_valid(grab));
    EXPECT_EQ(frond_grab_move(grab, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
    frond_grab_destroy(grab);
}

TEST(Misuse, HandlesOfADestroyedWorldAreStale) {
    frond_plant plant;
    frond_grab grab;
    frond_world world;
    {
        SmallWorld small;
        plant = small.plant;
        world = small.world;
        ASSERT_EQ(frond_grab_create(plant, {0, 1, 0}, 10, &grab), FROND_OK);
    }
    EXPECT_FALSE(frond_world_is_valid(world));
    EXPECT_FALSE(frond_plant_is_valid(plant));
    EXPECT_FALSE(frond_grab_is_valid(grab));
    SmallWorld another;  // reuses the freed slots; the old handles stay stale
    EXPECT_FALSE(frond_world_is_valid(world));
    EXPECT_FALSE(frond_plant_is_valid(plant));
    frond_plant_destroy(plant);
    EXPECT_TRUE(frond_plant_is_valid(another.plant));
}

TEST(Log, GoesWhereTheHostWants) {
    std::string heard;
    frond_set_log([](const char* message, void* user) { *static_cast<std::string*>(user) += message; }, &heard);
    const frond_stem stem = {
        -1, {0, 0, 0}, {0, 500, 0}, 10, 10};  // taller than any plant: the unit is guessed, with a warning
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_from_stems(&stem, 1, &def, &model), FROND_OK) << frond_last_error();
    EXPECT_FALSE(heard.empty());
    frond_set_log(nullptr, nullptr);
    frond_model_destroy(model);
}

TEST(Misuse, OfRigidBodiesIsRefused) {
    SmallWorld small;
    const frond_rigid_def good = frond_default_rigid_def();
    frond_rigid rigid = {7};
    EXPECT_EQ(frond_rigid_create(small.world, nullptr, &rigid), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(rigid.id, 0u);
    EXPECT_EQ(frond_rigid_create(small.world, &good, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_rigid_create({}, &good, &rigid), FROND_RESULT_BAD_HANDLE);
    const auto refused = [&](const frond_rigid_def& def, const char* word) {
        EXPECT_NE(frond_rigid_create(small.world, &def, &rigid), FROND_OK) << word;
        EXPECT_TRUE(error_names(word));
    };
    refused({}, "frond_default_rigid_def");
    frond_rigid_def def = good;
    def.shape = frond_shape(77);
    refused(def, "shape");
    for (double size : {0.0, -1.0, NOT_A_NUMBER, INFINITE, 1e9}) {
        def = good;
        def.size.x = size;
        refused(def, "size");
        def = good;
        def.mass = size == 0 ? -1 : size == 1e9 ? 1e30 : size;
        refused(def, "mass");
    }
    def = good;
    def.friction = -1;
    refused(def, "friction");
    def = good;
    def.state.rotation = {0, 0, 0, 0};
    refused(def, "rotation");
    def = good;
    def.state.velocity.z = NOT_A_NUMBER;
    refused(def, "velocity");

    ASSERT_EQ(frond_rigid_create(small.world, &good, &rigid), FROND_OK) << frond_last_error();
    EXPECT_TRUE(frond_rigid_is_valid(rigid));
    EXPECT_NE(frond_rigid_get_body(rigid), nullptr);
    frond_rigid_state state;
    EXPECT_EQ(frond_rigid_get_state(rigid, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_rigid_set_state(rigid, nullptr), FROND_RESULT_BAD_ARGUMENT);
    ASSERT_EQ(frond_rigid_get_state(rigid, &state), FROND_OK);
    state.position.x = INFINITE;
    EXPECT_EQ(frond_rigid_set_state(rigid, &state), FROND_RESULT_BAD_ARGUMENT);
    frond_rigid_destroy(rigid);
    frond_rigid_destroy(rigid);
    EXPECT_FALSE(frond_rigid_is_valid(rigid));
    EXPECT_EQ(frond_rigid_get_body(rigid), nullptr);
    EXPECT_EQ(frond_rigid_get_state(rigid, &state), FROND_RESULT_BAD_HANDLE);

    // A plane stays where it is, and a world's bodies are destroyed with it.
    def = good;
    def.shape = FROND_SHAPE_PLANE;
    ASSERT_EQ(frond_rigid_create(small.world, &def, &rigid), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_rigid_get_state(rigid, &state), FROND_OK);
    EXPECT_EQ(frond_rigid_set_state(rigid, &state), FROND_RESULT_BAD_ARGUMENT);
    frond_world_destroy(small.world);
    EXPECT_FALSE(frond_rigid_is_valid(rigid));
    EXPECT_EQ(frond_rigid_set_state(rigid, &state), FROND_RESULT_BAD_HANDLE);
}

TEST(Misuse, OfContactsIsRefused) {
    SmallWorld small;
    frond_contact contact;
    frond_vec3 momentum = {1, 1, 1};
    EXPECT_EQ(frond_plant_get_contact_count(small.plant), 0);
    EXPECT_EQ(frond_plant_get_contact_count({}), 0);
    EXPECT_EQ(frond_plant_get_contacts(small.plant, nullptr, 0), FROND_OK);
    EXPECT_EQ(frond_plant_get_contacts(small.plant, &contact, 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_contacts({}, &contact, 0), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_momentum(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_momentum({}, &momentum), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(momentum.x, 0);
}
