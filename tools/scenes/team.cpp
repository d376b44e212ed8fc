// A minimal job system: threads that wait for a batch of jobs and take the next remaining one.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "scenes/scene.hpp"

namespace frond::tools {

struct Team::Work {
    std::mutex mutex;
    std::condition_variable begins, ends;
    std::vector<std::thread> threads;
    uint64_t round = 0;
    int busy = 0;
    bool is_over = false;
    int count = 0;
    frond_job_fn* job = nullptr;
    void* data = nullptr;
    std::atomic<int> next{0};

    void take_jobs() {
        for (int i = next++; i < count; i = next++) job(data, i);
    }
    void wait_for_work() {
        for (uint64_t seen = 0;;) {
            std::unique_lock<std::mutex> lock(mutex);
            begins.wait(lock, [&] { return is_over || round != seen; });
            if (is_over) return;
            seen = round;
            lock.unlock();
            take_jobs();
            lock.lock();
            if (--busy == 0) ends.notify_one();
        }
    }
};

Team::Team(int threads) : work(std::make_unique<Work>()) {
    for (int i = 1; i < threads; i++) work->threads.emplace_back([this] { work->wait_for_work(); });
}

Team::~Team() {
    {
        std::lock_guard<std::mutex> lock(work->mutex);
        work->is_over = true;
    }
    work->begins.notify_all();
    for (std::thread& thread : work->threads) thread.join();
}

void Team::parallel_for(int count, frond_job_fn* job, void* data, void* user) {
    Work& work = *static_cast<Team*>(user)->work;
    {
        std::lock_guard<std::mutex> lock(work.mutex);
        work.count = count;
        work.job = job;
        work.data = data;
        work.next = 0;
        work.busy = int(work.threads.size());
        work.round++;
    }
    work.begins.notify_all();
    work.take_jobs();
    std::unique_lock<std::mutex> lock(work.mutex);
    work.ends.wait(lock, [&] { return work.busy == 0; });
}

}  // namespace frond::tools
