#include "view/panel_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "clock.h"
#include "error.h"
#include "view/panel_engine.h"

namespace diptych::core::app {

PanelWorker::PanelWorker(std::string backend, RendererFactory factory, std::uint32_t seed_offset)
    : backend_(std::move(backend)), seed_offset_(seed_offset),
      thread_([this, made = std::move(factory)]() mutable { run(std::move(made)); }) {}

PanelWorker::~PanelWorker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        cancel_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void PanelWorker::post(ViewJob job) {
    {
        const std::lock_guard lock(mutex_);
        // A job of the same picture lets what is being added to it come to its end.
        const bool other = !taken_ || invalidation(*taken_, job.state) != Change::nothing;
        waiting_ = std::move(job);
        cancel_ = cancel_ || (other && may_cancel_);
    }
    wake_.notify_one();
}

std::shared_ptr<const PanelShot> PanelWorker::shot() const {
    const std::lock_guard lock(mutex_);
    return shot_;
}

void PanelWorker::on_shot(std::function<void()> hook) {
    const std::lock_guard lock(mutex_);
    hook_ = std::move(hook);
}

void PanelWorker::request(Question question) {
    {
        const std::lock_guard lock(mutex_);
        requests_.push_back(std::move(question));
    }
    wake_.notify_one();
}

namespace {

/// A question that is answered once `ready`, and the future of the answer.
template <class Result, class Ready, class Ask>
auto answered(const Ready& ready, const Ask& ask) {
    const auto promise = std::make_shared<std::promise<Result>>();
    const auto question = [promise, ready, ask](PanelEngine* engine) {
        try {
            if (engine == nullptr) {
                throw Error("the panel has been closed");
            }
            if (!ready(*engine)) {
                return false;
            }
            promise->set_value(ask(*engine));
        } catch (...) {
            promise->set_exception(std::current_exception());
        }
        return true;
    };
    return std::pair(question, promise->get_future());
}

}  // namespace

std::future<RecordedPath> PanelWorker::record_path(const shared::PathQuery& query, std::uint32_t seed) {
    auto [question, future] =
        answered<RecordedPath>([](const PanelEngine&) { return true; },
                               [query, seed](PanelEngine& engine) { return engine.record_path(query, seed); });
    request(std::move(question));
    return std::move(future);
}

std::future<KeptFilm> PanelWorker::film() {
    auto [question, future] =
        answered<KeptFilm>([](const PanelEngine& engine) { return engine.has_picture() || !engine.wants_samples(); },
                           [](PanelEngine& engine) { return engine.film(); });
    request(std::move(question));
    return std::move(future);
}

void PanelWorker::recover(RendererFactory factory) {
    {
        const std::lock_guard lock(mutex_);
        factory_ = std::move(factory);
        PanelShot answered = *shot_;
        answered.device_lost = false;  // one loss, one recovery
        shot_ = std::make_shared<const PanelShot>(std::move(answered));
    }
    wake_.notify_one();
}

void PanelWorker::run(RendererFactory factory) {
    PanelEngine engine(backend_, seed_offset_, std::move(factory), [this](std::shared_ptr<const PanelShot> shot) {
        std::function<void()> hook;
        {
            const std::lock_guard lock(mutex_);
            if (factory_) {
                return;  // of a renderer whose successor waits already
            }
            shot_ = std::move(shot);
            hook = hook_;
        }
        if (hook) {
            hook();
        }
    });
    std::unique_lock lock(mutex_);
    while (true) {
        const auto called = [&] { return stop_ || waiting_ || factory_ || !requests_.empty(); };
        if (engine.wants_samples()) {
            wake_.wait_for(lock, std::chrono::duration<double>(engine.resumes() - now_seconds()), called);
        } else {
            wake_.wait(lock, called);
        }
        auto requests = std::exchange(requests_, {});
        if (stop_) {
            lock.unlock();
            for (const Question& question : requests) {
                question(nullptr);
            }
            return;
        }
        auto made = std::exchange(factory_, {});
        auto job = std::exchange(waiting_, {});
        if (job) {
            taken_ = job->state;
            cancel_ = false;
        }
        may_cancel_ = false;  // nothing is being rendered
        lock.unlock();
        if (made) {
            engine.recover(std::move(*made));
        }
        if (job) {
            engine.apply(*job);
        }
        const auto unanswered = std::remove_if(requests.begin(), requests.end(),
                                               [&](const Question& question) { return question(&engine); });
        requests.erase(unanswered, requests.end());
        lock.lock();
        requests_.insert(requests_.begin(), requests.begin(), requests.end());
        if (!engine.wants_samples() || stop_) {
            continue;
        }
        if (waiting_ && !engine.owes_first_sample()) {
            continue;  // no sample that nobody will see
        }
        may_cancel_ = !engine.owes_first_sample();
        lock.unlock();
        engine.advance(cancel_);
        lock.lock();
    }
}

}  // namespace diptych::core::app
