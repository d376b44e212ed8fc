// frond bench field: cost of a field that sleeps except along a path, of one all in wind, and of one with a crowd in
// it.
#include <btBulletDynamicsCommon.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "bench.hpp"
#include "quantile.hpp"
#include "study/report.hpp"

namespace frond::tools {

double now() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

namespace {

// Returns the memory that the process has allocated [kB].
double memory() {
    const struct mallinfo2 info = mallinfo2();
    return double(info.uordblks + info.hblkhd) / 1024;
}

frond_report report_of(const Stage& stage) {
    frond_report report;
    must(frond_world_get_report(stage.world, &report));
    return report;
}
frond_profile profile_of(const Stage& stage) {
    frond_profile profile;
    must(frond_world_get_profile(stage.world, &profile));
    return profile;
}

Settings field_settings(const BenchOptions& options, const std::vector<std::string>& assignments) {
    std::vector<std::string> all = assignments;
    all.insert(all.end(), options.assignments.begin(), options.assignments.end());
    return settings_of(cast("field"), all);
}

// A Bullet world with the field's plants as static bodies, and its ground, ball and walker.
struct StaticField {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btCollisionObject>> objects;
    btRigidBody* walker = nullptr;

    template <class Shape, class... Arguments>
    Shape* shape(Arguments... arguments) {
        shapes.push_back(std::make_unique<Shape>(arguments...));
        return static_cast<Shape*>(shapes.back().get());
    }
    btRigidBody* rigid(btCollisionShape* of, double mass, const frond_rigid_state& state) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) of->calculateLocalInertia(btScalar(mass), inertia);
        btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, of, inertia);
        const frond_vec3& p = state.position;
        info.m_startWorldTransform.setOrigin(btVector3(btScalar(p.x), btScalar(p.y), btScalar(p.z)));
        auto body = std::make_unique<btRigidBody>(info);
        btRigidBody* given = body.get();
        objects.push_back(std::move(body));
        world.addRigidBody(given);
        return given;
    }
    void add_plant(frond_plant plant) {
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
        btCompoundShape* compound = shape<btCompoundShape>();
        for (const frond_capsule& c : capsules) {
            const btVector3 begin(btScalar(c.begin.x), btScalar(c.begin.y), btScalar(c.begin.z));
            const btVector3 end(btScalar(c.end.x), btScalar(c.end.y), btScalar(c.end.z));
            const btScalar length = begin.distance(end);
            const btQuaternion turn =
                length > 0 ? shortestArcQuat(btVector3(0, 1, 0), (end - begin) / length) : btQuaternion::getIdentity();
            compound->addChildShape(btTransform(turn, (begin + end) / 2),
                                    shape<btCapsuleShape>(btScalar(c.radius), length));
        }
        objects.push_back(std::make_unique<btCollisionObject>());
        objects.back()->setCollisionShape(compound);
        world.addCollisionObject(objects.back().get(), btBroadphaseProxy::StaticFilter,
                                 btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
    }
    explicit StaticField(const Stage& stage) {
        for (frond_plant plant : stage.plants) add_plant(plant);
        const std::vector<frond_rigid_def>& defs = stage.rigid_defs;
        rigid(shape<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0, defs[0].state);
        btRigidBody* ball = rigid(shape<btSphereShape>(btScalar(defs[1].size.x)), defs[1].mass, defs[1].state);
        ball->setLinearVelocity(btVector3(btScalar(defs[1].state.velocity.x), 0, 0));
        walker = rigid(shape<btCapsuleShape>(btScalar(defs[2].size.x), btScalar(2 * defs[2].size.y)), 0, defs[2].state);
        walker->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        walker->setActivationState(DISABLE_DEACTIVATION);
    }
    ~StaticField() {
        for (const auto& object : objects) world.removeCollisionObject(object.get());
    }
    double step(double dt) {
        btTransform frame = walker->getWorldTransform();
        frame.getOrigin() += btVector3(btScalar(1.3 * dt), 0, 0);
        walker->setWorldTransform(frame);
        const double start = now();
        world.stepSimulation(btScalar(dt), 0);
        return now() - start;
    }
};

// Returns the memory that one more sleeping plant takes [kB], averaged over four kinds whose models and shared data
// exist already.
double memory_of_sleeper(const BenchOptions& options) {
    constexpr int COUNT = 1000;
    Play play(cast("field"), field_settings(options, {"patch_wind=0", "plants=4"}));
    const std::vector<frond_model>& models = play.stage.models;
    std::vector<frond_plant> plants;
    const auto plant = [&](int i) {
        frond_plant_def def = play.stage.settings.plant;
        def.position = {0.7 * (i % 32), 0, 20 + 0.7 * (i / 32)};
        frond_plant added = {};
        must(frond_plant_create(play.stage.world, models[size_t(i) % models.size()], &def, &added));
        plants.push_back(added);
    };
    for (size_t i = 0; i < models.size(); i++) plant(int(i));
    plants.reserve(models.size() + COUNT);
    const double before = memory();
    for (int i = 0; i < COUNT; i++) plant(int(models.size()) + i);
    return (memory() - before) / COUNT;
}

struct PathFigures {
    int plants;
    double whole, frond, still;  // medians: a step of the world, Frond's part of it, Bullet's with static bodies [ms]
    double awake;                // mean number of plants awake
    double beyond() const { return whole - still; }
};

// Measures steps in which all plants sleep except those along the path.
PathFigures measure_path(int count, const BenchOptions& options) {
    constexpr int WARM_UP = 30, STEPS = 240;
    const Casting casting = cast("field");
    PathFigures figures = {};
    figures.plants = count;
    Play play(casting, field_settings(options, {"patch_wind=0", "plants=" + std::to_string(count)}));
    StaticField still(play.stage);
    play.step();
    std::vector<double> whole, frond, bullet, awake;
    for (int i = 0; i < WARM_UP + STEPS; i++) {
        play.casting.scene->drive(play.stage);
        const double begin = now();
        must(frond_world_step(play.stage.world, play.stage.settings.dt));
        const double ms = now() - begin, ms_still = still.step(play.stage.settings.dt);
        if (i < WARM_UP) continue;
        const frond_report report = report_of(play.stage);
        whole.push_back(ms);
        frond.push_back(profile_of(play.stage).ms_step);
        bullet.push_back(ms_still);
        awake.push_back(report.awake_count);
    }
    figures.whole = median(whole);
    figures.frond = median(frond);
    figures.still = median(bullet);
    for (const double count_awake : awake) figures.awake += count_awake / double(awake.size());
    return figures;
}

// Measures a thousand rod plants of some forty segments in wind, at full detail wherever they are, by the stages of a
// step [ms].
void bench_wind(const BenchOptions& options) {
    constexpr int WARM_UP = 30, STEPS = 60, COUNT = 1000;
    const char* const PIECES = "capsule_height=0.24";  // [m]
    const char* const columns[] = {"world", "Frond", "air", "assembly", "solve", "capsules", "collide", "respond"};
    std::printf(
        "\n%d rod plants, all in a wind of 6 m/s at 10 m height, median [ms]; air, assembly, solve and capsules are "
        "sums "
        "of all threads'\n%8s %9s",
        COUNT, "threads", "segments");
    for (const char* column : columns) std::printf(" %9s", column);
    std::printf("\n");
    for (const int threads : {1, 2}) {
        Play play(cast("field"),
                  field_settings(options, {"patch_wind=0", "detail=0", "wind=6,0,0", PIECES,
                                           "plants=" + std::to_string(COUNT), "threads=" + std::to_string(threads)}));
        for (frond_plant plant : play.stage.plants) must(frond_plant_wake(plant));
        double segments = 0;
        for (frond_plant plant : play.stage.plants) segments += frond_plant_get_capsule_count(plant) / double(COUNT);
        std::vector<std::vector<double>> times(std::size(columns));
        for (int i = 0; i < WARM_UP + STEPS; i++) {
            play.casting.scene->drive(play.stage);
            const double begin = now();
            must(frond_world_step(play.stage.world, play.stage.settings.dt));
            const double ms = now() - begin;
            if (i < WARM_UP) continue;
            const frond_profile p = profile_of(play.stage);
            const double parts[] = {ms,         p.ms_step,     p.ms_effects, p.ms_assembly,
                                    p.ms_solve, p.ms_capsules, p.ms_collide, p.ms_response};
            for (size_t k = 0; k < times.size(); k++) times[k].push_back(parts[k]);
        }
        std::printf("%8d %9.0f", threads, segments);
        for (const std::vector<double>& column : times) std::printf(" %9.2f", median(column));
        std::printf("\n");
        std::fflush(stdout);
    }
}

// Measures fifty walkers that come in, with a budget or without.
void bench_crowd(const BenchOptions& options, double budget) {
    constexpr int STEPS = 600;
    Play play(cast("field"), field_settings(options, {"walkers=50", "budget=" + std::to_string(budget),
                                                      "plants=" + std::to_string(options.most)}));
    std::vector<double> ms;
    double awake = 0, simulated = 0;
    for (int i = 0; i < STEPS; i++) {
        play.step();
        const frond_report report = report_of(play.stage);
        ms.push_back(profile_of(play.stage).ms_step);
        awake += report.awake_count / double(STEPS);
        simulated += (report.detail_count[FROND_DETAIL_FULL] + report.detail_count[FROND_DETAIL_ROD]) / double(STEPS);
    }
    std::printf("%8.1f %9.2f %9.2f %9.2f %9.2f %9.1f %9.1f\n", budget, median(ms), quantile(ms, 0.95),
                quantile(ms, 0.99), quantile(ms, 1), awake, simulated);
    std::fflush(stdout);
}

std::string plot_of(const std::vector<PathFigures>& path, const std::string& base) {
    std::ostringstream plot;
    plot << "set xlabel 'plants in the field'\nset ylabel 'ms a step, median'\nset logscale xy\nset grid\n"
         << "set key left top\nset yrange [0.001:20]\n$data << EOD\n";
    for (const PathFigures& f : path)
        plot << f.plants << ' ' << f.whole << ' ' << f.still << ' ' << std::max(f.beyond(), 1e-3) << ' ' << f.frond
             << '\n';
    plot << "EOD\nplot $data using 1:2 with linespoints lw 2 pt 7 title 'the whole Bullet world', "
         << "$data using 1:3 with linespoints lw 2 pt 5 title 'Bullet alone, plants as static bodies', "
         << "$data using 1:4 with linespoints lw 2 pt 9 title 'beyond that', "
         << "2 with lines dt 2 lc 'gray' title '2 ms'\n";
    return study::drawn_twice(plot.str(), base);
}

}  // namespace

void bench_field(const BenchOptions& options) {
    study::prepare_diagrams(options.out);
    std::printf("scene field; one core unless stated\n%s, %s, frond %s %s\n", study::processor_name().c_str(),
                FROND_COMPILER, frond_version_string(), FROND_COMMIT);
    std::printf("one more plant that sleeps keeps %.2f kB beyond its model\n", memory_of_sleeper(options));
    std::printf("all asleep but a path on which one walks behind a ball, median [ms]\n");
    std::printf("%8s %8s %10s %10s %10s %10s\n", "plants", "awake", "world", "static", "beyond", "Frond");
    std::vector<PathFigures> path;
    for (int count = 1; count <= options.most; count *= 10) {
        path.push_back(measure_path(count, options));
        const PathFigures& f = path.back();
        std::printf("%8d %8.1f %10.3f %10.3f %10.3f %10.3f\n", f.plants, f.awake, f.whole, f.still, f.beyond(),
                    f.frond);
        std::fflush(stdout);
    }
    bench_wind(options);
    bench_kinds();
    std::printf("\na crowd of 50 comes into %d plants, Frond's time of a step [ms]\n%8s %9s %9s %9s %9s %9s %9s\n",
                options.most, "budget", "median", "95 %", "99 %", "most", "awake", "simulated");
    for (const double budget : {0.0, 8.0, 4.0, 2.0}) bench_crowd(options, budget);
    if (options.out.empty()) return;
    study::write_file(options.out + "/field.gp", plot_of(path, options.out + "/field"));
    study::run_gnuplot(options.out + "/field.gp");
}

}  // namespace frond::tools
