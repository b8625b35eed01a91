"""The network: a small U-Net over the range image, after RangeNet++ (Milioto et al., IROS 2019) with the encoder and decoder cut
down to what one thread of a small computer runs in 100 ms.

The stem halves the width (a scan has far more columns than rows) and the head gives it back: each output column holds the scores of
two input columns. Strides of 2 in both directions after that, sums over the skips, nearest-neighbour upsampling; nothing else, so that
the backend (modules/segmentation/convolutional_net.h) fuses each with its convolution. Rows must be a multiple of 16, columns of 32.
"""
import copy

import torch
from torch import nn
import torch.nn.functional as F


def convolution(inputs, outputs, kernel=3, stride=1):
    size = (kernel, kernel) if isinstance(kernel, int) else kernel
    padding = (size[0] // 2, size[1] // 2)
    return nn.Sequential(nn.Conv2d(inputs, outputs, size, stride, padding, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True))


class Residual(nn.Module):
    def __init__(self, channels):
        super().__init__()
        self.first = convolution(channels, channels)
        self.second = nn.Sequential(nn.Conv2d(channels, channels, 3, 1, 1, bias=False), nn.BatchNorm2d(channels))

    def forward(self, x):
        return F.relu(x + self.second(self.first(x)))


class Decoder(nn.Module):
    """Brings deeper features up to the skip's resolution and adds them."""

    def __init__(self, deep, channels):
        super().__init__()
        self.reduce = nn.Sequential(nn.Conv2d(deep, channels, 1, bias=False), nn.BatchNorm2d(channels))
        self.merge = convolution(channels, channels)

    def forward(self, deep, skip):
        return self.merge(F.relu(skip + F.interpolate(self.reduce(deep), scale_factor=2, mode="nearest")))


class RangeNet(nn.Module):
    def __init__(self, channels, classes, widths=(16, 32, 64, 96, 128)):
        super().__init__()
        self.config = {"channels": channels, "classes": classes, "widths": list(widths)}
        a, b, c, d, e = widths
        self.stem = convolution(channels, a, (3, 5), (1, 2))
        self.encode1 = Residual(a)
        self.encode2 = nn.Sequential(convolution(a, b, 3, 2), Residual(b))
        self.encode3 = nn.Sequential(convolution(b, c, 3, 2), Residual(c))
        self.encode4 = nn.Sequential(convolution(c, d, 3, 2), Residual(d))
        self.encode5 = nn.Sequential(convolution(d, e, 3, 2), Residual(e), Residual(e))
        self.decode4 = Decoder(e, d)
        self.decode3 = Decoder(d, c)
        self.decode2 = Decoder(c, b)
        self.decode1 = Decoder(b, a)
        self.head = nn.Conv2d(a, 2 * classes, 1)

    def forward(self, x):
        """(n, 2 * classes, rows, columns / 2): class k of input column 2 j + s in channel s * classes + k, column j."""
        x1 = self.encode1(self.stem(x))
        x2 = self.encode2(x1)
        x3 = self.encode3(x2)
        x4 = self.encode4(x3)
        x = self.decode4(self.encode5(x4), x4)
        x = self.decode3(x, x3)
        x = self.decode2(x, x2)
        return self.head(self.decode1(x, x1))


def scores(output):
    """(n, classes, rows, columns) of what the network gives."""
    n, channels, rows, half = output.shape
    return output.view(n, 2, channels // 2, rows, half).permute(0, 2, 3, 4, 1).reshape(n, channels // 2, rows, 2 * half)


def folded(model):
    """A copy without batch normalisation: folded into the convolutions before it (OpenCV 4.6 refuses what PyTorch exports of it)."""
    model = copy.deepcopy(model).eval()
    for module in list(model.modules()):
        if not isinstance(module, nn.Sequential):
            continue
        for i in range(len(module) - 1):
            if isinstance(module[i], nn.Conv2d) and isinstance(module[i + 1], nn.BatchNorm2d):
                module[i] = nn.utils.fuse_conv_bn_eval(module[i], module[i + 1])
                module[i + 1] = nn.Identity()
    return model


def multiply_adds(model, rows=64, columns=1024):
    """Of one pass."""
    total = 0

    def count(layer, _, out):
        nonlocal total
        total += out.numel() // out.shape[1] * layer.weight.numel()

    hooks = [m.register_forward_hook(count) for m in model.modules() if isinstance(m, nn.Conv2d)]
    with torch.no_grad():
        model(torch.zeros(1, model.config["channels"], rows, columns))
    for hook in hooks:
        hook.remove()
    return total
