// A loop within a graph: a conditional node, whose body a kernel lets run again.
#include "backend/check.hpp"
#include "backend/context.hpp"
#include "backend/error.hpp"

namespace slagflow {

#if CUDART_VERSION >= 12040

namespace {

constexpr const char* what = "loop of a graph";

__global__ void decide(cudaGraphConditionalHandle loop, const std::int32_t* flag) {
  cudaGraphSetConditional(loop, goes_on(flag) ? 1 : 0);
}

// Where a recording stands: its graph, and the nodes that the next one waits for.
struct Recorded {
  cudaGraph_t graph = nullptr;
  const cudaGraphNode_t* last = nullptr;
  std::size_t count = 0;

  explicit Recorded(cudaStream_t stream) {
    cudaStreamCaptureStatus status{};
#if CUDART_VERSION >= 13000
    check(cudaStreamGetCaptureInfo(stream, &status, nullptr, &graph, &last, nullptr, &count), what);
#else
    check(cudaStreamGetCaptureInfo(stream, &status, nullptr, &graph, &last, &count), what);
#endif
  }
};

// Goes on after a node that was added by hand.
void add_node(cudaStream_t stream, cudaGraphNodeParams& parameters) {
  const Recorded here(stream);
  cudaGraphNode_t node = nullptr;
#if CUDART_VERSION >= 13000
  check(cudaGraphAddNode(&node, here.graph, here.last, nullptr, here.count, &parameters), what);
  check(cudaStreamUpdateCaptureDependencies(stream, &node, nullptr, 1, cudaStreamSetCaptureDependencies),
        what);
#else
  check(cudaGraphAddNode(&node, here.graph, here.last, here.count, &parameters), what);
  check(cudaStreamUpdateCaptureDependencies(stream, &node, 1, cudaStreamSetCaptureDependencies), what);
#endif
}

}  // namespace

// Decided once before the loop, which may take no turn, and at the end of each.
void Context::record_loop(const std::int32_t* flag, const std::function<void()>& body) {
  const auto outer = static_cast<cudaStream_t>(stream());
  recorded_loop_ = true;
  cudaGraphConditionalHandle handle{};
  check(cudaGraphConditionalHandleCreate(&handle, Recorded(outer).graph, 0, cudaGraphCondAssignDefault),
        what);
  const auto launch_decision = [&] {
    count_launch();
    decide<<<1, 1, 0, static_cast<cudaStream_t>(stream())>>>(handle, flag);
    check(cudaGetLastError(), what);
  };
  launch_decision();
  cudaGraphNodeParams loop{};
  loop.type = cudaGraphNodeTypeConditional;
  loop.conditional.handle = handle;
  loop.conditional.type = cudaGraphCondTypeWhile;
  loop.conditional.size = 1;
  add_node(outer, loop);
  cudaGraph_t graph = loop.conditional.phGraph_out[0];
  swap_streams();
  const auto inner = static_cast<cudaStream_t>(stream());
  try {
    check(cudaStreamBeginCaptureToGraph(inner, graph, nullptr, nullptr, 0, cudaStreamCaptureModeThreadLocal),
          what);
    body();
    launch_decision();
  } catch (...) {
    swap_streams();
    cudaStreamEndCapture(inner, &graph);
    throw;
  }
  swap_streams();
  check(cudaStreamEndCapture(inner, &graph), what);
}

#else

void Context::record_loop(const std::int32_t*, const std::function<void()>&) {
  throw Error("CUDA: a loop of a graph needs " + missing_for_loops());
}

#endif

}  // namespace slagflow
