#include <tbb/blocked_range.h>

#include "backend/cpu_renderer.h"
#include "parallel.h"
#include "stability_backend.h"

namespace diptych::core::stability {

namespace {

using Measure = void (*)(const MeasuredInput&, MeasuredOutput&);

#define NAME_MEASURE(name) shared::measure_##name,
constexpr Measure measures[] = {MEASURED_FUNCTIONS(NAME_MEASURE)};
#undef NAME_MEASURE

class CpuBackend : public Backend {
public:
    explicit CpuBackend(int threads) : threads_(threads) {}

    std::string name() const override { return "cpu"; }
    std::string device() const override { return cpu_name(); }

    std::vector<MeasuredOutput> run(Function function, std::span<const MeasuredInput> inputs) override {
        std::vector<MeasuredOutput> outputs(inputs.size());
        const Measure measure = measures[static_cast<std::size_t>(function)];
        parallel_over(tbb::blocked_range<std::size_t>(0, inputs.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                measure(inputs[i], outputs[i]);
            }
        });
        return outputs;
    }

    std::unique_ptr<Renderer> make_renderer(const PackedScene& packed) override {
        return make_cpu_renderer(packed, threads_);
    }

private:
    int threads_;
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend(int threads) {
    return std::make_unique<CpuBackend>(threads);
}

}  // namespace diptych::core::stability
