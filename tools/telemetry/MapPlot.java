package saker.telemetry;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics2D;
import java.awt.geom.AffineTransform;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Path2D;
import java.awt.geom.Rectangle2D;
import java.io.IOException;
import java.util.ArrayDeque;
import java.util.LinkedHashMap;
import java.util.Map;
import lcm.lcm.LCMDataInputStream;
import lcm.spy.SpyPlugin;
import saker.candidate_t;
import saker.map_object_t;
import saker.object_map_t;
import saker.odometry_t;
import saker.plan_t;

/** From above, x to the right, in metres: objects of the map (world), the path flown (odom), viewpoints weighed. */
public class MapPlot extends Plot implements SpyPlugin {
  public MapPlot() {
    super("Map", object_map_t.LCM_FINGERPRINT);
  }

  @Override
  String[] channels() {
    return new String[] {"_OBJECTS", "_ODOMETRY", "_PLAN"};
  }

  @Override
  Picture picture(String robot) {
    return new TopView();
  }

  private static class TopView implements Picture {
    private static final int MOST_OBJECTS = 10000;
    private static final int MOST_POSES = 20000;
    private static final double STEP_M = 0.2;  // between points of the path
    private static final double MARGIN_M = 3;
    private static final float THIN_M = 0.05f;
    private static final double GRID_M = 10;

    private final Map<Integer, map_object_t> objects = new LinkedHashMap<>();
    private final ArrayDeque<double[]> path = new ArrayDeque<>();
    private plan_t plan = new plan_t();

    @Override
    public void hear(String channel, LCMDataInputStream message) throws IOException {
      switch (channel) {
        case "_OBJECTS" -> hear(new object_map_t(message));
        case "_ODOMETRY" -> hear(new odometry_t(message));
        default -> plan = new plan_t(message);
      }
    }

    private void hear(object_map_t map) {
      for (map_object_t object : map.objects) {
        if (object.observations == 0) objects.remove(object.id);
        else if (objects.size() < MOST_OBJECTS || objects.containsKey(object.id)) objects.put(object.id, object);
      }
    }

    private void hear(odometry_t odometry) {
      double[] p = odometry.position;
      double[] last = path.peekLast();
      if (last != null && Math.hypot(p[0] - last[0], p[1] - last[1]) < STEP_M) return;
      path.add(p.clone());
      if (path.size() > MOST_POSES) path.remove();
    }

    @Override
    public void draw(Graphics2D g, Dimension size) {
      Rectangle2D area = new Rectangle2D.Double(-MARGIN_M, -MARGIN_M, 2 * MARGIN_M, 2 * MARGIN_M);
      for (map_object_t object : objects.values()) area.add(object.position[0], object.position[1]);
      for (double[] p : path) area.add(p[0], p[1]);
      g.setColor(Color.DARK_GRAY);
      g.drawString(objects.size() + " objects; a square of the grid is 10 m", 8, 16);
      double scale = Math.min(size.width / (area.getWidth() + 2 * MARGIN_M), size.height / (area.getHeight() + 2 * MARGIN_M));
      g.translate(size.width / 2.0, size.height / 2.0);
      g.scale(scale, -scale);
      g.translate(-area.getCenterX(), -area.getCenterY());
      g.setStroke(new BasicStroke(THIN_M));
      drawGrid(g, area);
      drawPath(g);
      for (map_object_t object : objects.values()) draw(g, object);
      drawCandidates(g);
    }

    private void drawGrid(Graphics2D g, Rectangle2D area) {
      g.setColor(Color.LIGHT_GRAY);
      double left = area.getMinX() - MARGIN_M, right = area.getMaxX() + MARGIN_M;
      double low = area.getMinY() - MARGIN_M, high = area.getMaxY() + MARGIN_M;
      for (double x = Math.ceil(left / GRID_M) * GRID_M; x < right; x += GRID_M) line(g, x, low, x, high);
      for (double y = Math.ceil(low / GRID_M) * GRID_M; y < high; y += GRID_M) line(g, left, y, right, y);
    }

    private static void line(Graphics2D g, double x1, double y1, double x2, double y2) {
      g.draw(new java.awt.geom.Line2D.Double(x1, y1, x2, y2));
    }

    private void drawPath(Graphics2D g) {
      if (path.isEmpty()) return;
      Path2D line = new Path2D.Double();
      for (double[] p : path) {
        if (line.getCurrentPoint() == null) line.moveTo(p[0], p[1]);
        else line.lineTo(p[0], p[1]);
      }
      g.setColor(Color.BLUE);
      g.draw(line);
      double[] now = path.getLast();
      g.fill(new Ellipse2D.Double(now[0] - 0.4, now[1] - 0.4, 0.8, 0.8));
    }

    /** Filled as far as its class is sure. */
    private static void draw(Graphics2D g, map_object_t object) {
      float[] q = object.orientation;
      double yaw = Math.atan2(2 * (q[3] * q[2] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
      double length = object.size[0], width = object.size[1];
      boolean cuboid = object.shape == map_object_t.CUBOID;
      AffineTransform before = g.getTransform();
      g.translate(object.position[0], object.position[1]);
      g.rotate(yaw);
      var outline = cuboid ? new Rectangle2D.Double(-length / 2, -width / 2, length, width)
                           : new Ellipse2D.Double(-length / 2, -width / 2, length, width);
      int sure = Float.isNaN(object.probability) ? 0 : Math.round(160 * Math.min(1, object.probability));
      g.setColor(cuboid ? new Color(200, 60, 0, sure) : new Color(0, 120, 40, sure));
      g.fill(outline);
      g.setColor(Color.BLACK);
      g.draw(outline);
      g.setTransform(before);
    }

    private void drawCandidates(Graphics2D g) {
      for (int i = 0; i < plan.num_candidates; ++i) {
        candidate_t candidate = plan.candidates[i];
        if (candidate.gain < 0) continue;  // refused
        double x = candidate.position[0], y = candidate.position[1];
        g.setColor(i == plan.choice ? Color.RED : Color.GRAY);
        g.draw(new Ellipse2D.Double(x - 0.3, y - 0.3, 0.6, 0.6));
        line(g, x, y, x + Math.cos(candidate.yaw), y + Math.sin(candidate.yaw));
      }
    }
  }
}
