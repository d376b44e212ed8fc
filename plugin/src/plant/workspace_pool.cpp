// A plant's step needs a workspace of some hundred kilobytes, and no part of it afterwards: plants of one system take
// turns.
#include "plant/plant_step.hpp"

#include "core/assert.hpp"

namespace frond {

void PoolSeat::take() {
    if (is_taken) return;
    std::lock_guard<std::mutex> lock(pool->mutex);
    pool->seats++;
    is_taken = true;
}

void PoolSeat::leave() {
    if (!is_taken) return;
    std::lock_guard<std::mutex> lock(pool->mutex);
    FROND_ASSERT(pool->seats > 0);
    pool->seats--;
    while (pool->free.size() > pool->seats) pool->free.pop_back();
    while (pool->batch.size() > pool->seats) pool->batch.pop_back();
    is_taken = false;
}

void take_workspace(Plant& plant) {
    if (plant.step.workspace) return;
    FROND_ASSERT(plant.seat.is_taken);
    {
        std::lock_guard<std::mutex> lock(plant.seat.pool->mutex);
        if (!plant.seat.pool->free.empty()) {
            plant.step.workspace = std::move(plant.seat.pool->free.back());
            plant.seat.pool->free.pop_back();
        }
    }
    if (!plant.step.workspace) plant.step.workspace = make_workspace(plant.system);
    use_elements(*plant.step.workspace, plant.state.own_elements.get());
}

void return_workspace(Plant& plant) {
    if (!plant.step.workspace) return;
    std::lock_guard<std::mutex> lock(plant.seat.pool->mutex);
    plant.seat.pool->free.push_back(std::move(plant.step.workspace));
}

}  // namespace frond
