// A Vulkan loader that loses things on demand: the system's, but that a file decides when a call fails. The file named
// by DIPTYCH_LOSE holds the call's name and its result, "vkQueueSubmit -4"; the next such call takes the file away and
// returns that. A device that is lost so (VK_ERROR_DEVICE_LOST) stays lost: what is submitted to it vanishes, and all
// waits say so. Below it everything goes on as if nothing had happened, so a validation layer there sees whether the
// rest is used and destroyed as it should.
#include <dlfcn.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace {

struct Lost {
    std::mutex mutex;
    std::mutex queues;  // the wait of fail() is nobody else's, so it keeps off their queues itself
    std::set<VkDevice> devices;
    std::map<VkQueue, VkDevice> device_of;
};

Lost& lost() {
    static Lost all;
    return all;
}

PFN_vkGetInstanceProcAddr system_loader() {
    static const auto entry = reinterpret_cast<PFN_vkGetInstanceProcAddr>(
        dlsym(dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL), "vkGetInstanceProcAddr"));
    return entry;
}

PFN_vkGetDeviceProcAddr device_entry = nullptr;  // the system's

template <typename Function>
Function real(VkDevice device, const char* name) {
    return reinterpret_cast<Function>(device_entry(device, name));
}

/// What the file says of this call; VK_SUCCESS where it does not name it.
VkResult ordered(const char* call) {
    const char* file = std::getenv("DIPTYCH_LOSE");
    if (file == nullptr || access(file, R_OK) != 0) {
        return VK_SUCCESS;
    }
    std::string name;
    int result = 0;
    std::ifstream(file) >> name >> result;
    if (name != call || unlink(file) != 0) {
        return VK_SUCCESS;
    }
    return static_cast<VkResult>(result);
}

/// Whether the call on this device fails, and how.
VkResult verdict(VkDevice device, const char* call) {
    const std::lock_guard lock(lost().mutex);
    if (lost().devices.contains(device)) {
        return VK_ERROR_DEVICE_LOST;
    }
    const VkResult result = ordered(call);
    if (result == VK_ERROR_DEVICE_LOST) {
        lost().devices.insert(device);
    }
    return result;
}

VkDevice device_of(VkQueue queue) {
    const std::lock_guard lock(lost().mutex);
    return lost().device_of.at(queue);
}

/// A device that is lost has come to rest, so that what it used may be destroyed.
VkResult fail(VkDevice device, VkResult result) {
    if (result == VK_ERROR_DEVICE_LOST) {
        const std::lock_guard lock(lost().queues);
        real<PFN_vkDeviceWaitIdle>(device, "vkDeviceWaitIdle")(device);
    }
    return result;
}

void VKAPI_CALL get_queue(VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
    real<PFN_vkGetDeviceQueue>(device, "vkGetDeviceQueue")(device, family, index, queue);
    const std::lock_guard lock(lost().mutex);
    lost().device_of[*queue] = device;
}

void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    const auto destroy = real<PFN_vkDestroyDevice>(device, "vkDestroyDevice");
    {
        const std::lock_guard lock(lost().mutex);
        lost().devices.erase(device);  // its address may be another's soon
    }
    destroy(device, allocator);
}

VkResult VKAPI_CALL queue_submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    const VkDevice device = device_of(queue);
    if (const VkResult result = verdict(device, "vkQueueSubmit"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    const std::lock_guard lock(lost().queues);
    return real<PFN_vkQueueSubmit>(device, "vkQueueSubmit")(queue, count, infos, fence);
}

VkResult VKAPI_CALL queue_present(VkQueue queue, const VkPresentInfoKHR* info) {
    const VkDevice device = device_of(queue);
    if (const VkResult result = verdict(device, "vkQueuePresentKHR"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    const std::lock_guard lock(lost().queues);
    return real<PFN_vkQueuePresentKHR>(device, "vkQueuePresentKHR")(queue, info);
}

VkResult VKAPI_CALL wait_for_fences(VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all,
                                    uint64_t timeout) {
    if (const VkResult result = verdict(device, "vkWaitForFences"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    return real<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all, timeout);
}

VkResult VKAPI_CALL device_wait_idle(VkDevice device) {
    if (const VkResult result = verdict(device, "vkDeviceWaitIdle"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    const std::lock_guard lock(lost().queues);
    return real<PFN_vkDeviceWaitIdle>(device, "vkDeviceWaitIdle")(device);
}

VkResult VKAPI_CALL acquire_next_image(VkDevice device, VkSwapchainKHR swapchain, uint64_t timeout,
                                       VkSemaphore semaphore, VkFence fence, uint32_t* index) {
    if (const VkResult result = verdict(device, "vkAcquireNextImageKHR"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    return real<PFN_vkAcquireNextImageKHR>(device, "vkAcquireNextImageKHR")(device, swapchain, timeout, semaphore,
                                                                            fence, index);
}

VkResult VKAPI_CALL create_swapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                     const VkAllocationCallbacks* allocator, VkSwapchainKHR* swapchain) {
    if (const VkResult result = verdict(device, "vkCreateSwapchainKHR"); result != VK_SUCCESS) {
        return fail(device, result);
    }
    return real<PFN_vkCreateSwapchainKHR>(device, "vkCreateSwapchainKHR")(device, info, allocator, swapchain);
}

template <typename Function>
PFN_vkVoidFunction pointer(Function* function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction VKAPI_CALL get_device_proc(VkDevice device, const char* name) {
    const std::map<std::string, PFN_vkVoidFunction> wrapped = {
        {"vkGetDeviceQueue", pointer(get_queue)},
        {"vkDestroyDevice", pointer(destroy_device)},
        {"vkQueueSubmit", pointer(queue_submit)},
        {"vkQueuePresentKHR", pointer(queue_present)},
        {"vkWaitForFences", pointer(wait_for_fences)},
        {"vkDeviceWaitIdle", pointer(device_wait_idle)},
        {"vkAcquireNextImageKHR", pointer(acquire_next_image)},
        {"vkCreateSwapchainKHR", pointer(create_swapchain)},
        {"vkGetDeviceProcAddr", pointer(get_device_proc)},
    };
    const PFN_vkVoidFunction found = device_entry(device, name);
    const auto own = wrapped.find(name);
    return found != nullptr && own != wrapped.end() ? own->second : found;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) PFN_vkVoidFunction VKAPI_CALL
vkGetInstanceProcAddr(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = system_loader()(instance, name);
    if (found != nullptr && std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        device_entry = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
        return pointer(get_device_proc);
    }
    return std::strcmp(name, "vkGetInstanceProcAddr") == 0 ? pointer(vkGetInstanceProcAddr) : found;
}
