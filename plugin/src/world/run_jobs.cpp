// Runs jobs of a substep on the host's threads or by Bullet's task scheduler. Debian builds Bullet without
// BT_THREADSAFE, whose btParallelFor then asserts, so the scheduler is called directly.
#include <LinearMath/btThreads.h>

#include <exception>

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Keeps an exception of a job, which the thread that waits for all jobs throws again.
struct Jobs : btIParallelForBody {
    const std::function<void(size_t)>& job;
    mutable std::mutex mutex;
    mutable std::exception_ptr error;
    explicit Jobs(const std::function<void(size_t)>& job) : job(job) {}
    void run(int i) const noexcept {
        try {
            job(size_t(i));
        } catch (...) {
            std::lock_guard<std::mutex> lock(mutex);
            error = std::current_exception();
        }
    }
    void forLoop(int begin, int end) const override {
        for (int i = begin; i < end; i++) run(i);
    }
};

void run_one(void* data, int index) {
    static_cast<const Jobs*>(data)->run(index);
}

}  // namespace

void run_jobs(const World& world, size_t count, const std::function<void(size_t)>& job) {
    Jobs jobs(job);
    btITaskScheduler* scheduler = btGetTaskScheduler();
    if (count > 1 && world.parallel_for)
        world.parallel_for(int(count), run_one, &jobs, world.parallel_user);
    else if (count > 1 && scheduler && scheduler->getNumThreads() > 1)
        scheduler->parallelFor(0, int(count), 1, jobs);
    else
        jobs.forLoop(0, int(count));
    if (jobs.error) std::rethrow_exception(jobs.error);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
