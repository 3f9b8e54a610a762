#include "backend/check.hpp"
#include "backend/launch_graph.hpp"

namespace slagflow {

struct LaunchGraph::Native {
  cudaGraphExec_t executable = nullptr;
  cudaGraph_t looping = nullptr;  // the graph it was made of, where that has a loop

  ~Native() { drop(); }
  void drop() {
    if (executable) cudaGraphExecDestroy(executable);
    if (looping) cudaGraphDestroy(looping);
    executable = nullptr, looping = nullptr;
  }

  // Kernels hold the handle of a loop, and that of another graph is another one: nothing is updated.
  // Launching one by one in its place is not what was asked for.
  void take_looping(cudaGraph_t graph) {
    drop();
    looping = graph;
    check(cudaGraphInstantiate(&executable, graph, 0), "graph with a loop");
  }

  // Another step's graph mostly differs in the numbers of its kernels only. What the runtime cannot do it
  // says in its last error, too, where the next launch would find it.
  bool take(cudaGraph_t graph) {
    cudaGraphExecUpdateResultInfo result{};
    if (executable && cudaGraphExecUpdate(executable, graph, &result) == cudaSuccess) return true;
    drop();
    const bool taken = cudaGraphInstantiate(&executable, graph, 0) == cudaSuccess;
    cudaGetLastError();
    return taken;
  }
};

LaunchGraph::LaunchGraph(Context& context, const char* label)
    : context_(context), label_(label), native_(std::make_unique<Native>()) {}
LaunchGraph::~LaunchGraph() = default;

// False where the runtime does not make a graph of it.
bool LaunchGraph::record_anew(const std::function<void()>& record) {
  const auto stream = static_cast<cudaStream_t>(context_.stream());
  if (cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal) != cudaSuccess) {
    cudaGetLastError();
    return false;
  }
  context_.recording_ = true;
  context_.recorded_loop_ = false;
  context_.recorded_launches_ = 0;
  ++context_.counts_.graph_recordings;
  cudaGraph_t graph = nullptr;
  const auto end = [&] {
    context_.recording_ = false;
    return cudaStreamEndCapture(stream, &graph);
  };
  try {
    record();
  } catch (...) {
    if (end() == cudaSuccess) cudaGraphDestroy(graph);
    cudaGetLastError();
    throw;
  }
  check(end(), label_);
  if (context_.recorded_loop_) {
    native_->take_looping(graph);
    return true;
  }
  const bool taken = native_->take(graph);
  check(cudaGraphDestroy(graph), label_);
  return taken;
}

void LaunchGraph::run(const Numbers& now, const std::function<void()>& record) {
  if (singly_) return record();
  if (!holds_ || numbers_ != now || generation_ != context_.generation()) {
    holds_ = false;
    if (!record_anew(record)) {
      singly_ = true;
      return record();
    }
    holds_ = true, numbers_ = now, generation_ = context_.generation();
    kernels_ = context_.recorded_launches_;
  }
  Section timer(context_, label_);
  check(cudaGraphLaunch(native_->executable, static_cast<cudaStream_t>(context_.stream())), label_);
  ++context_.counts_.graph_launches;
  context_.counts_.graph_kernels += kernels_;
}

}  // namespace slagflow
